// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/eval/report/plot.hpp"

#include <gmock/gmock.h>

namespace terracut::evaluation::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Plot, EndsAxesAtRoundNumbersThatHoldEverything) {
  EXPECT_DOUBLE_EQ(from_zero(95.925).to, 100);
  EXPECT_DOUBLE_EQ(from_zero(4.17).to, 5);
  EXPECT_DOUBLE_EQ(from_zero(100).to, 100);
  EXPECT_DOUBLE_EQ(from_zero(0.003).to, 0.003);
  EXPECT_DOUBLE_EQ(from_zero(0).to, 1);
}

TEST(Plot, StepsByOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(tick_step({0, 100}, 5), 20);
  EXPECT_DOUBLE_EQ(tick_step({0, 7}, 5), 2);
  EXPECT_DOUBLE_EQ(tick_step({90, 100}, 4), 5);
  EXPECT_DOUBLE_EQ(tick_step({0, 0.9}, 5), 0.2);
}

TEST(Plot, PutsValuesInProportionWithLargeOnesUpAndRight) {
  const Plot plot(400, 200, {0, 10}, {50, 100}, "a plot");
  EXPECT_LT(plot.x(0), plot.x(10));
  EXPECT_GT(plot.y(50), plot.y(100));
  EXPECT_DOUBLE_EQ(plot.x(5), (plot.x(0) + plot.x(10)) / 2);
  EXPECT_DOUBLE_EQ(plot.y(75), (plot.y(50) + plot.y(100)) / 2);
  EXPECT_GE(plot.x(0), 0);
  EXPECT_LE(plot.x(10), 400);
  EXPECT_GE(plot.y(100), 0);
  EXPECT_LE(plot.y(50), 200);
}

TEST(Plot, TextsAreNoMarkup) {
  Plot plot(400, 200, {0, 1}, {0, 1}, "a & b");
  plot.y_axis("<50 %>");
  plot.svg().disc(1, 1, 1, "red", "<tip>");
  EXPECT_THAT(plot.svg().element(), HasSubstr("&lt;50 %&gt;"));
  EXPECT_THAT(plot.svg().element(), HasSubstr("a &amp; b"));
  EXPECT_THAT(plot.svg().element(), Not(HasSubstr("<tip>")));
}

}  // namespace
}  // namespace terracut::evaluation::report
