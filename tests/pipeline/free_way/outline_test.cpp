// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/free_way/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pipeline/free_way/way_grid.hpp"

namespace terracut::free_way {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Four sectors, clockwise: ahead to the right, behind to the right, behind to the left, ahead to
/// the left.
std::vector<Sector> four_sectors() {
  constexpr float kEighth_rad = std::numbers::pi_v<float> / 4;
  return {{-kEighth_rad, 8, 5, SeenEnd::kRows},
          {-3 * kEighth_rad, kInfinity, 10, SeenEnd::kDrop},
          {3 * kEighth_rad, kInfinity, 0, SeenEnd::kLost},
          {kEighth_rad, 4, 3.5F, SeenEnd::kObstacle}};
}

Cell cell_at(const WayGrid& grid, float x_m, float y_m) {
  const auto place = [](float at_m) {
    return static_cast<std::size_t>((at_m - WayGrid::kFirst_m) / WayGrid::kCell_m);
  };
  return grid.cells[place(y_m) * WayGrid::kSide + place(x_m)];
}

/// True if the cell or one that touches it is occupied: a corner may be crossed between two others.
bool is_occupied_near(const WayGrid& grid, float x_m, float y_m) {
  for (const float aside_m : {-0.1F, 0.0F, 0.1F}) {
    if (cell_at(grid, x_m + aside_m, y_m) == Cell::kOccupied ||
        cell_at(grid, x_m, y_m + aside_m) == Cell::kOccupied) {
      return true;
    }
  }
  return false;
}

TEST(Outline, GoesAroundEachSectorCounterclockwise) {
  const std::vector<Corner> corners = outline(four_sectors());
  ASSERT_EQ(corners.size(), 8U);
  const std::vector<Corner> expected{{3.5, 0}, {0, 3.5}, {0, 0},  {0, 0},
                                     {-10, 0}, {0, -10}, {0, -5}, {5, 0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_NEAR(corners[i].x_m, expected[i].x_m, 1e-5) << i;
    EXPECT_NEAR(corners[i].y_m, expected[i].y_m, 1e-5) << i;
  }
}

TEST(Outline, OfNoSectorsIsEmpty) {
  EXPECT_TRUE(outline({}).empty());
}

TEST(Sector, TowardsAPlaceIsTheOneThatItLiesIn) {
  const std::vector<Sector> sectors = four_sectors();
  EXPECT_EQ(&sector_towards(clockwise_turns({3, -1}), sectors), &sectors[0]);
  EXPECT_EQ(&sector_towards(clockwise_turns({-3, -1}), sectors), &sectors[1]);
  EXPECT_EQ(&sector_towards(clockwise_turns({-3, 1}), sectors), &sectors[2]);
  EXPECT_EQ(&sector_towards(clockwise_turns({3, 1}), sectors), &sectors[3]);
  EXPECT_EQ(&sector_towards(clockwise_turns({3, 0}), sectors), &sectors[0]) << "straight ahead";
}

TEST(Sector, StopsAtTheNearestObstacleOrTheEdgeOfADropBeforeIt) {
  const std::vector<Sector> sectors = four_sectors();
  EXPECT_EQ(sectors[0].stop_m(), 8);
  EXPECT_EQ(sectors[1].stop_m(), 10);
  EXPECT_EQ(sectors[2].stop_m(), kInfinity);
  EXPECT_EQ(sectors[3].stop_m(), 4);
}

TEST(WayGrid, IsFreeWhereGroundWasSeenAndOccupiedWhereAVehicleMustStop) {
  WayGrid grid;
  grid.fill(four_sectors());
  EXPECT_EQ(cell_at(grid, 3.1F, -3.1F), Cell::kFree);
  EXPECT_EQ(cell_at(grid, 4.3F, -4.3F), Cell::kUnknown) << "before the obstacle, not seen";
  const float at_8_m = 8 / std::numbers::sqrt2_v<float>;
  EXPECT_TRUE(is_occupied_near(grid, at_8_m, -at_8_m));
  EXPECT_EQ(cell_at(grid, 9, -9), Cell::kUnknown) << "behind it";
  EXPECT_EQ(cell_at(grid, -6, -6), Cell::kFree);
  const float at_10_m = 10 / std::numbers::sqrt2_v<float>;
  EXPECT_TRUE(is_occupied_near(grid, -at_10_m, -at_10_m)) << "the edge of the drop";
  EXPECT_EQ(cell_at(grid, -1, 1), Cell::kUnknown) << "nothing was seen";
}

TEST(WayGrid, HasNoGapBetweenTheCellsOfAnObstacleAllAround) {
  std::vector<Sector> sectors = four_sectors();
  for (Sector& sector : sectors) sector = {sector.azimuth_rad, 12, 11, SeenEnd::kObstacle};
  WayGrid grid;
  grid.fill(sectors);
  for (float azimuth_rad = -3.1F; azimuth_rad < 3.1F; azimuth_rad += 0.001F) {
    EXPECT_TRUE(is_occupied_near(grid, 12 * std::cos(azimuth_rad), 12 * std::sin(azimuth_rad)))
        << azimuth_rad;
  }
}

TEST(WayGrid, IsUnknownWithoutSectors) {
  WayGrid grid;
  grid.fill(four_sectors());
  grid.fill({});
  for (const Cell cell : grid.cells) ASSERT_EQ(cell, Cell::kUnknown);
}

}  // namespace
}  // namespace terracut::free_way
