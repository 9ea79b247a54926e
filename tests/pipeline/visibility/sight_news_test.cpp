// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/visibility/sight_news.hpp"

#include <gtest/gtest.h>

#include <string>

namespace terracut::visibility {
namespace {

struct NewsOfAView : testing::Test {
  NewsOfAView() {
    figures.has_learnt = 1;
    for (SightFigures::Sector& sector : figures.sectors) sector = {{}, 1, 30};
  }
  SightNews::News look(double at_s, Condition ahead) {
    figures.sectors[0].condition = ahead;
    return news.look(figures, static_cast<std::int64_t>(at_s * 1e9));
  }

  static constexpr Condition kClear{};
  static constexpr Condition kSpray{State::kReduced, Cause::kAirborne};
  static constexpr Condition kCovered{State::kBlocked, Cause::kCovered};
  SightFigures figures;
  SightNews news;
};

TEST_F(NewsOfAView, SayOnceWhatIsInTheWayAndOnceThatItIsGone) {
  EXPECT_EQ(look(1, kClear).text, "");
  const SightNews::News covered = look(2, kCovered);
  EXPECT_EQ(covered.text, "the sensor's view is blocked, covered: 1 sector, ahead");
  EXPECT_TRUE(covered.is_trouble);
  EXPECT_EQ(look(3, kCovered).text, "");
  EXPECT_EQ(look(10, kCovered).text, "");
  EXPECT_EQ(look(10.1, kClear).text, "") << "it may come back";
  const SightNews::News over = look(15.1, kClear);
  EXPECT_EQ(over.text, "the sensor's view is clear again; it was not for 8.0 s");
  EXPECT_FALSE(over.is_trouble);
  EXPECT_EQ(look(16, kClear).text, "");
}

TEST_F(NewsOfAView, SayThatATroubleIsOverAfterFiveSecondsAndNotBefore) {
  EXPECT_NE(look(0, kSpray).text, "");
  EXPECT_EQ(look(4.999, kClear).text, "");
  EXPECT_NE(look(5, kClear).text, "");
}

TEST_F(NewsOfAView, TakeWhatComesAndGoesForOneTrouble) {
  EXPECT_NE(look(0, kSpray).text, "");
  for (double at_s = 1; at_s < 60; at_s += 2) {
    EXPECT_EQ(look(at_s, kClear).text, "") << at_s;
    EXPECT_EQ(look(at_s + 1, kSpray).text, "") << at_s;
  }
  EXPECT_NE(look(70, kClear).text, "");
}

TEST_F(NewsOfAView, SayWhatComesInItsPlace) {
  EXPECT_NE(look(0, kSpray).text, "");
  EXPECT_NE(look(1, kCovered).text, "");
  EXPECT_EQ(look(2, kSpray).text, "the sensor's view is reduced, airborne: 1 sector, ahead");
  EXPECT_EQ(look(10, kClear).text, "the sensor's view is clear again; it was not for 2.0 s");
}

}  // namespace
}  // namespace terracut::visibility
