// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/remembered/street_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace terracut::remembered {
namespace {

struct StreetGridTest : testing::Test {
  memory::FixedMemory memory;
  StreetGrid grid{{}, memory};

  static frame::Place place(double x_m, double y_m, double heading_rad = 0) {
    return {1, x_m, y_m, std::cos(heading_rad), std::sin(heading_rad)};
  }
  std::uint32_t box(float x_m, float y_m, float height_m) const {
    const std::uint32_t square = grid.square_of(x_m, y_m);
    return square == StreetGrid::kOutside ? square : grid.box_of(square, height_m);
  }
};

TEST_F(StreetGridTest, KnowsNothingAtFirst) {
  grid.begin_frame(place(0, 0));
  EXPECT_EQ(grid.said_before(box(5, 1, 0)), 0);
}

TEST_F(StreetGridTest, AFrameIsHeardFromTheNextOneOn) {
  grid.begin_frame(place(0, 0));
  for (int i = 0; i < 3; ++i) grid.add(box(5, 1, 0), StreetGrid::kSure);
  EXPECT_EQ(grid.said_before(box(5, 1, 0)), 0);
  grid.begin_frame(place(0, 0));
  EXPECT_GT(grid.said_before(box(5, 1, 0)), StreetGrid::kSure / 3);
  EXPECT_EQ(grid.said_before(box(5, 1, 0.3F)), 0) << "another layer";
  EXPECT_EQ(grid.said_before(box(7, 1, 0)), 0) << "another square";
}

TEST_F(StreetGridTest, TheStreetStandsWhileTheVehicleDrivesAndTurns) {
  const double there_x = 12.3, there_y = 4.7;
  grid.begin_frame(place(0, 0));
  grid.add(box(static_cast<float>(there_x), static_cast<float>(there_y), 0), -StreetGrid::kSure);
  const double heading = 0.4, at_x = 9, at_y = -3;
  grid.begin_frame(place(at_x, at_y, heading));
  const double dx = there_x - at_x, dy = there_y - at_y;
  EXPECT_LT(grid.said_before(
                box(static_cast<float>(std::cos(heading) * dx + std::sin(heading) * dy),
                    static_cast<float>(-std::sin(heading) * dx + std::cos(heading) * dy), 0)),
            -StreetGrid::kSure / 3);
}

TEST_F(StreetGridTest, WhatLeavesTheWindowIsForgottenAndNotFoundAgainElsewhere) {
  grid.begin_frame(place(0, 0));
  for (float x = -50; x < 50; x += 0.4F) {
    for (float y = -50; y < 50; y += 0.4F) grid.add(box(x, y, 0), StreetGrid::kSure);
  }
  grid.begin_frame(place(30, -20));
  int known = 0;
  for (float x = -50; x < 50; x += 0.4F) {
    for (float y = -50; y < 50; y += 0.4F) {
      const bool was_seen = x + 30 < 49.5F && y - 20 > -49.5F;
      const bool was_not = x + 30 > 52 || y - 20 < -52;
      if (was_seen) known += grid.said_before(box(x, y, 0)) > 0 ? 1 : 0;
      EXPECT_TRUE(!was_not || grid.said_before(box(x, y, 0)) == 0) << x << " " << y;
    }
  }
  EXPECT_GT(known, 20'000);
  grid.begin_frame(place(30'000, 0));
  EXPECT_EQ(grid.said_before(box(0, 0, 0)), 0);
}

TEST_F(StreetGridTest, WhatIsNotSeenAgainFades) {
  grid.begin_frame(place(0, 0));
  grid.add(box(5, 1, 0), StreetGrid::kSure);
  int before = StreetGrid::kSure;
  for (int frame = 0; frame < 6; ++frame) {
    grid.begin_frame(place(0, 0));
    EXPECT_LT(grid.said_before(box(5, 1, 0)), before);
    before = grid.said_before(box(5, 1, 0));
  }
  EXPECT_LT(before, 5);
  for (int frame = 0; frame < 40; ++frame) grid.begin_frame(place(0, 0));
  EXPECT_EQ(grid.said_before(box(5, 1, 0)), 0);
}

TEST_F(StreetGridTest, PlacesOutsideOfTheWindowAndNoPlacesHaveNoSquare) {
  grid.begin_frame(place(1000, -2000, 1));
  EXPECT_EQ(grid.square_of(80, 0), StreetGrid::kOutside);
  EXPECT_EQ(grid.square_of(NAN, 0), StreetGrid::kOutside);
  EXPECT_EQ(grid.box_of(0, 3), StreetGrid::kOutside);
  EXPECT_EQ(grid.box_of(0, NAN), StreetGrid::kOutside);
}

}  // namespace
}  // namespace terracut::remembered
