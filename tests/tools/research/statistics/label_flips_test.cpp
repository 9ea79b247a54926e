// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/statistics/label_flips.hpp"

#include <gtest/gtest.h>

#include "tools/research/datasets/built_in_tables.hpp"

namespace terracut::statistics {
namespace {

using encode::RigidMotion;
using frame::Label;

constexpr RigidMotion kAtRest{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
constexpr std::uint32_t kRoad = 40, kCar = 10, kMovingCar = 252, kUnlabelled = 0;

struct LabelFlipsTest : testing::Test {
  datasets::ClassTable classes = *datasets::built_in_table("semantickitti");
  LabelFlips flips{classes, 1};

  struct Point {
    scan::ScanPoint place;
    std::uint32_t label;
  };
  static scan::KittiScan scan_of(const std::vector<Point>& points) {
    scan::KittiScan scan;
    for (const Point& point : points) {
      scan.points.push_back(point.place);
      scan.labels.push_back(point.label);
    }
    return scan;
  }
};

TEST_F(LabelFlipsTest, TheFirstFrameHasNone) {
  flips.look_at(scan_of({{{5, 0, 0, 0}, kRoad}}), std::nullopt);
  EXPECT_EQ(flips.count(0, std::vector{Label::kGround}), FlipCounts{});
}

TEST_F(LabelFlipsTest, AReturnSeenAgainIsComparedWithTheNearest) {
  flips.look_at(scan_of({{{5, 0, 0, 0}, kRoad}, {{5.08F, 0, 0, 0}, kCar}}), std::nullopt);
  (void)flips.count(0, std::vector{Label::kGround, Label::kObstacle});
  flips.look_at(scan_of({{{5.05F, 0, 0, 0}, kRoad}, {{5.3F, 0, 0, 0}, kRoad}}), kAtRest);
  const auto counts = flips.count(0, std::vector{Label::kGround, Label::kObstacle});
  EXPECT_EQ(counts, (FlipCounts{.returns = 1, .flips = 1, .true_flips = 1}));
}

TEST_F(LabelFlipsTest, TheSensorsMotionIsRemoved) {
  flips.look_at(scan_of({{{20, 3, -1.5F, 0}, kRoad}}), std::nullopt);
  (void)flips.count(0, std::vector{Label::kGround});
  RigidMotion two_metres_on = kAtRest;
  two_metres_on[3] = 2;
  flips.look_at(scan_of({{{18, 3, -1.5F, 0}, kRoad}}), two_metres_on);
  EXPECT_EQ(flips.count(0, std::vector{Label::kOtherGround}).returns, 1U);
  EXPECT_EQ(flips.count(0, std::vector{Label::kOtherGround}).flips, 0U);
}

TEST_F(LabelFlipsTest, WhatMovesOrHasNoClassCountsNowhere) {
  flips.look_at(scan_of({{{5, 0, 0, 0}, kMovingCar}, {{-5, 0, 0, 0}, kUnlabelled}}), std::nullopt);
  (void)flips.count(0, std::vector{Label::kGround, Label::kGround});
  flips.look_at(scan_of({{{5, 0, 0, 0}, kRoad}, {{-5, 0, 0, 0}, kRoad}}), kAtRest);
  EXPECT_EQ(flips.count(0, std::vector{Label::kObstacle, Label::kObstacle}).returns, 0U);
}

}  // namespace
}  // namespace terracut::statistics
