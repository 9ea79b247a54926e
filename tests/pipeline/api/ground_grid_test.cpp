// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/ground_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/allocation_counter.hpp"

namespace terracut {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Returns on a plane, and above it, that a test adds one by one.
struct Returns {
  float slope_x = 0, slope_y = 0;
  std::vector<Point> points;
  std::vector<Label> labels;
  std::vector<float> heights_m;

  [[nodiscard]] float ground_m(float x_m, float y_m) const { return slope_x * x_m + slope_y * y_m; }
  void add(float x_m, float y_m, float height_m, Label label) {
    points.push_back({x_m, y_m, ground_m(x_m, y_m) + height_m});
    labels.push_back(label);
    heights_m.push_back(height_m);
  }
  /// Ground in the middle of every cell of half a metre of a rectangle.
  void add_ground(float from_x_m, float to_x_m, float from_y_m, float to_y_m) {
    for (float x_m = from_x_m + 0.25F; x_m < to_x_m; x_m += 0.5F) {
      for (float y_m = from_y_m + 0.25F; y_m < to_y_m; y_m += 0.5F) {
        add(x_m, y_m, 0, Label::kGround);
      }
    }
  }
};

struct GroundGridTest : testing::Test {
  GroundGrid grid = GroundGrid::make({.cell_m = 0.5, .reach_m = 10, .longest_gap_m = 2}).value();
  Returns returns;

  void update() { ASSERT_TRUE(grid.update(returns.points, returns.labels, returns.heights_m)); }
  [[nodiscard]] GroundKnown known(float x_m, float y_m) const {
    return grid.known()[grid.cell_at(x_m, y_m)];
  }
  [[nodiscard]] float height_m(float x_m, float y_m) const {
    return grid.height_m()[grid.cell_at(x_m, y_m)];
  }
  [[nodiscard]] float slope_deg(float x_m, float y_m) const {
    return grid.slope_deg()[grid.cell_at(x_m, y_m)];
  }
};

TEST_F(GroundGridTest, HasTheHeightAndTheSlopeOfGroundThatWasSeen) {
  returns.slope_x = 0.10F;
  returns.slope_y = -0.05F;
  returns.add_ground(-10, 10, -10, 10);
  update();
  EXPECT_EQ(grid.size(), 40U);
  EXPECT_EQ(grid.cells(), 1600U);
  const double slope_deg = std::atan(std::hypot(0.10, 0.05)) * 180 / 3.14159265358979;
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    ASSERT_EQ(grid.known()[cell], GroundKnown::kSeen);
    ASSERT_NEAR(grid.slope_deg()[cell], slope_deg, 0.01) << cell;
  }
  EXPECT_NEAR(height_m(7.25F, -3.25F), returns.ground_m(7.25F, -3.25F), 1e-5);
}

TEST_F(GroundGridTest, CellsAreCountedFromBehindAndFromTheRight) {
  EXPECT_EQ(grid.cell_at(-10, -10), 0U);
  EXPECT_EQ(grid.cell_at(-10, -9.4F), 1U) << "y, to the left, is a column";
  EXPECT_EQ(grid.cell_at(-9.4F, -10), 40U) << "x, ahead, is a row";
  EXPECT_EQ(grid.cell_at(9.99F, 9.99F), 1599U);
  for (const float outside : {-10.01F, 10.0F, kNaN}) {
    EXPECT_EQ(grid.cell_at(outside, 0), grid.cells());
    EXPECT_EQ(grid.cell_at(0, outside), grid.cells());
  }
}

TEST_F(GroundGridTest, GroundBelowThingsIsThatFoundThereAndSaidToBeInterpolated) {
  returns.slope_x = 0.05F;
  returns.add_ground(-10, 4, -10, 10);
  returns.add(5.25F, 0.25F, 1.5F, Label::kObstacle);
  returns.add(5.25F, 0.25F, 0.5F, Label::kObstacle);
  update();
  EXPECT_EQ(known(5.25F, 0.25F), GroundKnown::kInterpolated);
  EXPECT_NEAR(height_m(5.25F, 0.25F), returns.ground_m(5.25F, 0.25F), 1e-5);
  returns.add(1.25F, 1.25F, 2.5F, Label::kObstacle);
  update();
  EXPECT_EQ(known(1.25F, 1.25F), GroundKnown::kSeen) << "there is ground as well, and it counts";
  EXPECT_NEAR(height_m(1.25F, 1.25F), returns.ground_m(1.25F, 1.25F), 1e-5);
}

TEST_F(GroundGridTest, GapsAreInterpolatedAsFarAsTheyMayBeAndNoFarther) {
  returns.slope_x = 0.2F;
  returns.add_ground(-10, 2, -10, 10);
  returns.add_ground(4, 6, -10, 10);      // 2 m farther
  returns.add_ground(8.5F, 10, -10, 10);  // 2.5 m farther
  update();
  for (float x_m = 2.25F; x_m < 4; x_m += 0.5F) {
    EXPECT_EQ(known(x_m, 0.25F), GroundKnown::kInterpolated);
    EXPECT_NEAR(height_m(x_m, 0.25F), returns.ground_m(x_m, 0.25F), 1e-4);
    EXPECT_NEAR(slope_deg(x_m, 0.25F), 11.31, 0.01);
  }
  for (float x_m = 6.25F; x_m < 8.5F; x_m += 0.5F) {
    EXPECT_EQ(known(x_m, 0.25F), GroundKnown::kUnknown);
    EXPECT_TRUE(std::isnan(height_m(x_m, 0.25F)));
    EXPECT_TRUE(std::isnan(slope_deg(x_m, 0.25F)));
  }
}

TEST_F(GroundGridTest, ALoneCellHasAHeightAndNoSlope) {
  returns.add(3.25F, 3.25F, 0, Label::kOtherGround);
  update();
  EXPECT_EQ(known(3.25F, 3.25F), GroundKnown::kSeen);
  EXPECT_EQ(height_m(3.25F, 3.25F), 0);
  EXPECT_TRUE(std::isnan(slope_deg(3.25F, 3.25F)));
}

TEST_F(GroundGridTest, IsOfTheLastReturnsAlone) {
  returns.add_ground(-10, 10, -10, 10);
  update();
  returns = {};
  update();
  EXPECT_TRUE(
      std::ranges::all_of(grid.known(), [](GroundKnown k) { return k == GroundKnown::kUnknown; }));
  EXPECT_TRUE(std::ranges::all_of(grid.height_m(), [](float h) { return std::isnan(h); }));
}

TEST_F(GroundGridTest, PointsWithoutAHeightAndThoseFartherAwayAreLeftOut) {
  returns.add(1, 1, kNaN, Label::kNone);
  returns.add(100, 0, 0, Label::kGround);
  returns.add(kNaN, 0, 0, Label::kGround);
  update();
  EXPECT_EQ(std::ranges::count(grid.known(), GroundKnown::kUnknown), 1600);
}

TEST_F(GroundGridTest, AFrameWithoutHeightsIsRefusedAndTheCellsStay) {
  returns.add(3.25F, 3.25F, 0, Label::kGround);
  update();
  const Status refused = grid.update(Frame{.points = returns.points, .labels = returns.labels});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(known(3.25F, 3.25F), GroundKnown::kSeen);
}

TEST(GroundGrid, SettingsOutOfRangeAreRefused) {
  for (const GroundGrid::Config& config :
       {GroundGrid::Config{.cell_m = 0.01}, GroundGrid::Config{.cell_m = kNaN},
        GroundGrid::Config{.reach_m = 300}, GroundGrid::Config{.longest_gap_m = -1},
        GroundGrid::Config{.cell_m = 0.05, .reach_m = 200}}) {
    EXPECT_EQ(GroundGrid::make(config).error().code, ErrorCode::kInvalidArgument);
  }
}

TEST_F(GroundGridTest, GivesTheSameCellsAgainAndAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place_m(-12, 12), height_m(-0.1F, 3);
  for (int i = 0; i < 20'000; ++i) {
    const float h = height_m(random);
    returns.add(place_m(random), place_m(random), h, h < 0.2F ? Label::kGround : Label::kObstacle);
  }
  update();
  const std::vector<float> first(grid.height_m().begin(), grid.height_m().end());
  const std::uint64_t before = test::allocations_of_this_thread();
  update();
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
  EXPECT_TRUE(std::ranges::equal(first, grid.height_m()));
}

}  // namespace
}  // namespace terracut
