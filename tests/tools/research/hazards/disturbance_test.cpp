// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/disturbance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "flat_scene.hpp"

namespace terracut::hazards {
namespace {

class DisturbanceTest : public testing::Test {
 protected:
  [[nodiscard]] MovedReturns moved(std::string_view word, std::uint64_t key = 5) const {
    const auto found = std::ranges::find(disturbances(), word, &Disturbance::word);
    if (found == disturbances().end()) throw std::runtime_error("no such disturbance");
    return disturbed(frame_, *found, key);
  }
  [[nodiscard]] double times_as_far(const MovedReturn& one) const {
    return one.range_m / frame_.range_m[one.index];
  }
  template <class Is>
  [[nodiscard]] double number_of(Is&& is) const {
    double number = 0;
    for (std::size_t i = 0; i < frame_.size(); ++i) number += is(i) ? 1 : 0;
    return number;
  }

  const FlatScene scene_;
  const LabelledFrame frame_ = scene_.labelled();
};

TEST_F(DisturbanceTest, GhostsLieBelowTheGroundAndStartNearerThan40Metres) {
  const double low = number_of([&](std::size_t i) { return frame_.ground_range_m(i) < 40; });
  for (const auto& [word, share] :
       {std::pair{"ghosts_0.1", 0.001}, {"ghosts_1", 0.01}, {"ghosts_5", 0.05}}) {
    const MovedReturns ghosts = moved(word);
    EXPECT_NEAR(static_cast<double>(ghosts.size()) / low, share, 0.15 * share) << word;
    for (const MovedReturn& ghost : ghosts) {
      EXPECT_LT(frame_.ground_range_m(ghost.index), 40);
      EXPECT_GE(times_as_far(ghost), 1.1);
      EXPECT_LT(times_as_far(ghost), 1.6);
    }
  }
}

TEST_F(DisturbanceTest, APuddleMirrorsHalfOfItsGround) {
  const auto is_in = [&](std::size_t i) {
    const double ahead_m = std::abs(frame_.at[i].x());
    return ahead_m >= 6 && ahead_m <= 14 && std::abs(frame_.at[i].y()) <= 2.2;
  };
  const MovedReturns mirrored = moved("puddle");
  EXPECT_NEAR(static_cast<double>(mirrored.size()) / number_of(is_in), 0.5, 0.03);
  for (const MovedReturn& one : mirrored) {
    EXPECT_TRUE(is_in(one.index));
    EXPECT_GE(times_as_far(one), 1.3);
    EXPECT_LT(times_as_far(one), 2.5);
  }
}

TEST_F(DisturbanceTest, SnowAndSprayEndBeamsInTheAir) {
  EXPECT_NEAR(static_cast<double>(moved("snow_1").size()),
              0.01 * static_cast<double>(frame_.size()),
              0.001 * static_cast<double>(frame_.size()));
  for (const char* const word : {"snow_10", "spray"}) {
    const MovedReturns stopped = moved(word);
    EXPECT_FALSE(stopped.empty()) << word;
    for (const MovedReturn& one : stopped) EXPECT_LT(times_as_far(one), 1) << word;
  }
}

TEST_F(DisturbanceTest, DirtTakesAwayAllReturnsOfASector) {
  const MovedReturns gone = moved("dirt");
  EXPECT_NEAR(static_cast<double>(gone.size()), static_cast<double>(frame_.size()) * 20 / 360,
              0.002 * static_cast<double>(frame_.size()));
  for (const MovedReturn& one : gone) EXPECT_EQ(one.range_m, 0);
}

TEST_F(DisturbanceTest, IsDrawnByItsKey) {
  const auto indices = [](const MovedReturns& moved) {
    std::vector<std::uint32_t> list;
    for (const MovedReturn& one : moved) list.push_back(one.index);
    return list;
  };
  EXPECT_EQ(indices(moved("ghosts_1", 5)), indices(moved("ghosts_1", 5)));
  EXPECT_NE(indices(moved("ghosts_1", 5)), indices(moved("ghosts_1", 6)));
}

}  // namespace
}  // namespace terracut::hazards
