// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/row_opening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace terracut::elevation {
namespace {

/// Two rows close together on the ground, and two far from the next: at 20 m and at 40 m.
mount::RingProfile profile_of_four() {
  mount::RingProfile profile;
  for (const double distance_m : {5.0, 5.5, 20.0, 40.0}) {
    profile.rings.push_back({-std::atan(1.73 / distance_m), 0, distance_m});
  }
  return profile;
}

struct OpeningOfARow : testing::Test {
  static constexpr frame::ImageShape kShape{4, 1800};
  static constexpr int kRow = 2;

  OpeningOfARow()
      : grid({}, profile_of_four(), kShape, memory),
        stage({.window_m = 5}, 0.06F, grid, profile_of_four(), memory),
        z_m(1800, 0.0F),
        range_m(1800, 20.0F) {}
  void open() {
    stage.take(kRow, {0, grid.sectors()}, z_m.data(), range_m.data(), grid);
    for (int sector = 0; sector < grid.sectors(); ++sector) stage.open(sector);
  }
  /// Puts a thing of this width around the middle of a sector onto the ground.
  void put(int sector, float width_m, float height_m) {
    const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
    const int middle = (columns.begin + columns.end) / 2;
    const float column_m = 2 * std::numbers::pi_v<float> / 1800 * 20;
    const int half = static_cast<int>(width_m / column_m / 2);
    for (int column = middle - half; column <= middle + half; ++column) {
      z_m[static_cast<std::size_t>((column + 1800) % 1800)] = height_m;
    }
  }
  [[nodiscard]] float height_above(int sector, float height_m) const {
    return height_m - stage.opening_m(kRow, sector);
  }
  memory::FixedMemory memory;
  RingGrid grid;
  RowOpening stage;
  std::vector<float> z_m, range_m;
};

TEST_F(OpeningOfARow, ARowNearTheNextTellsNothing) {
  EXPECT_FALSE(stage.has(0));
  EXPECT_TRUE(stage.has(1));
  EXPECT_TRUE(stage.has(2));
  EXPECT_TRUE(stage.has(3)) << "the last ring before the horizon";
}

TEST_F(OpeningOfARow, ACarStandsOutOfALevelRoadAlsoAcrossTheSeam) {
  for (const int sector : {50, 0}) {
    std::fill(z_m.begin(), z_m.end(), 0.0F);
    put(sector, 1.8F, 0.5F);
    open();
    EXPECT_GT(height_above(sector, 0.5F), 0.35F) << sector;
    EXPECT_LT(height_above(sector + 10, 0.0F), 0.01F) << sector;
  }
}

TEST_F(OpeningOfARow, AWallWiderThanTheWindowDoesNotStandOut) {
  put(50, 14, 0.5F);
  open();
  EXPECT_NEAR(height_above(50, 0.5F), 0, 1e-4F);
}

TEST_F(OpeningOfARow, ABankThatRisesAlongTheRowDoesNotStandOut) {
  for (std::size_t column = 0; column < z_m.size(); ++column) {
    const auto angle = static_cast<float>(column) / 1800 * 2 * std::numbers::pi_v<float>;
    z_m[column] = 0.5F * std::sin(angle);
  }
  open();
  for (int sector = 0; sector < grid.sectors(); ++sector) {
    const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
    EXPECT_LT(height_above(sector, z_m[static_cast<std::size_t>(columns.begin)]), 0.05F) << sector;
  }
}

TEST_F(OpeningOfARow, WhereNothingReturnsNothingStandsOut) {
  const frame::ColumnRange columns = grid.columns_of({50, 51});
  for (int column = columns.begin; column < columns.end; ++column) {
    z_m[static_cast<std::size_t>(column)] = std::numeric_limits<float>::quiet_NaN();
  }
  open();
  EXPECT_LT(height_above(50, 10), 0);
}

TEST_F(OpeningOfARow, LooksFourSectorsAhead) {
  // A wall that ends behind a sector, and so many sectors ahead of it.
  for (const int ahead : {4, 5}) {
    std::fill(z_m.begin(), z_m.end(), 0.0F);
    const frame::ColumnRange wall = grid.columns_of({50, 50 + ahead});
    std::fill(z_m.begin() + wall.begin, z_m.begin() + wall.end, 0.5F);
    open();
    EXPECT_EQ(height_above(50, 0.5F) > 0.25F, ahead == 4) << ahead;
  }
}

}  // namespace
}  // namespace terracut::elevation
