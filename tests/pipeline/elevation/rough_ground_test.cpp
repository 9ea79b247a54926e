// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/rough_ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/support/synthetic_frame.hpp"

namespace terracut::elevation {
namespace {

/// Every return 10 m away and on level ground, until a test says otherwise.
struct GroundEverywhere : testing::Test {
  static constexpr frame::ImageShape kShape{64, 960};
  static constexpr float kObstacle_m = 0.15F;
  static constexpr int kRow = 20, kColumn = 45;

  GroundEverywhere()
      : grid({}, test::even_profile(), kShape, memory),
        z_m(kShape.cells(), 0.0F),
        range_m(kShape.cells(), 10.0F) {}

  void put(int row, int column, float to_m) { z_m[kShape.cell(row, column)] = to_m; }
  /// Five rows of some columns at this height, uneven by so much from one column to the next.
  void put_strip(float low_m, float uneven_m) {
    for (int row = kRow - 2; row <= kRow + 2; ++row) {
      for (int column = kColumn - 40; column < kColumn + 40; ++column) {
        put(row, column, low_m + (column % 2 == 0 ? uneven_m : 0.0F));
      }
    }
  }
  /// Levels all rows, the columns in these parts.
  void level(const std::vector<frame::ColumnRange>& parts = {{0, kShape.columns}}) {
    std::vector<float> highest_m(grid.cells(), -1e9F);
    std::vector<std::int32_t> cell(kShape.cells());
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const std::size_t i = kShape.cell(row, column);
        const std::size_t of_grid =
            grid.cell(grid.sector_of(column), grid.mix_of(range_m[i]).inner);
        cell[i] = static_cast<std::int32_t>(of_grid);
        if (z_m[i] > highest_m[of_grid]) highest_m[of_grid] = z_m[i];
      }
    }
    height_m = z_m;
    rough.reset();
    rough.find_highest_near({0, grid.sectors()}, grid, highest_m,
                            std::vector<GroundSurface::EdgeHeights>(grid.cells()));
    std::vector<float> highest_near_m(kShape.cells());
    for (std::size_t i = 0; i < cell.size(); ++i) {
      highest_near_m[i] = rough.highest_near_m()[static_cast<std::size_t>(cell[i])];
    }
    for (const frame::ColumnRange columns : parts) {
      for (int row = 0; row < kShape.rows; ++row) {
        const std::size_t first = kShape.cell(row, columns.begin);
        rough.level({z_m.data(), z_m.data(), z_m.data(), range_m.data()}, row, columns,
                    std::span(highest_near_m).subspan(first, columns.size()), grid,
                    std::span(height_m).subspan(first, columns.size()));
      }
    }
  }
  [[nodiscard]] float height(int row, int column) const {
    return height_m[kShape.cell(row, column)];
  }

  RoughGround::Config config;
  memory::FixedMemory memory;
  RingGrid grid;
  std::vector<float> z_m, range_m, height_m;
  RoughGround rough{config, kObstacle_m, grid, kShape, memory};
};

TEST_F(GroundEverywhere, AStepThatNothingTallStandsNearIsLevel) {
  put(kRow, kColumn, 0.12F);
  level();
  EXPECT_EQ(height(kRow, kColumn), 0);
}

TEST_F(GroundEverywhere, TheFootOfSomethingTallKeepsItsHeight) {
  put(kRow, kColumn, 0.12F);
  put(kRow + 9, kColumn, 0.5F);
  level();
  EXPECT_EQ(height(kRow, kColumn), 0.12F);
  EXPECT_EQ(height(kRow + 9, kColumn), 0.5F);
}

TEST_F(GroundEverywhere, WhatIsBelowTheGroundStaysThere) {
  put(kRow, kColumn, -0.1F);
  level();
  EXPECT_EQ(height(kRow, kColumn), -0.1F);
}

TEST_F(GroundEverywhere, SomethingTallFarBehindIsNotNear) {
  put(kRow, kColumn, 0.12F);
  put(kRow + 9, kColumn, 0.5F);
  range_m[kShape.cell(kRow + 9, kColumn)] = 20.0F;
  level();
  EXPECT_EQ(height(kRow, kColumn), 0);
}

TEST_F(GroundEverywhere, SomethingTallIsNearSoManySectorsAsideAcrossTheSeamToo) {
  const int sector_columns = kShape.columns / grid.sectors();
  for (const int aside : {-3, -2, 2, 3}) {
    std::ranges::fill(z_m, 0.0F);
    put(kRow, 0, 0.12F);
    put(kRow + 9, (aside * sector_columns + kShape.columns) % kShape.columns, 0.5F);
    level();
    EXPECT_EQ(height(kRow, 0), std::abs(aside) <= config.near_sectors ? 0.12F : 0.0F) << aside;
  }
}

TEST_F(GroundEverywhere, AHighKerbIsAnObstacleBecauseItIsSmooth) {
  put_strip(0.2F, 0.004F);
  level();
  EXPECT_GE(height(kRow, kColumn), 0.2F);
}

TEST_F(GroundEverywhere, GrassOfTheSameHeightIsLevel) {
  put_strip(0.2F, 0.03F);
  level();
  EXPECT_EQ(height(kRow, kColumn), 0);
}

TEST_F(GroundEverywhere, GrassWithGapsIsLevel) {
  put_strip(0.2F, 0.03F);
  for (int row = kRow - 2; row <= kRow + 2; ++row) {
    for (int column = 0; column < kShape.columns; column += 5) {
      put(row, column, std::numeric_limits<float>::quiet_NaN());
    }
  }
  level();
  EXPECT_EQ(height(kRow, kColumn + 1), 0);
}

TEST_F(GroundEverywhere, OneUnevenReturnDoesNotMakeAKerbRough) {
  put_strip(0.2F, 0.0F);
  put(kRow, kColumn, 0.3F);
  level();
  EXPECT_EQ(height(kRow, kColumn + 2), 0.2F);
  EXPECT_EQ(height(kRow, kColumn), 0.3F);
}

TEST_F(GroundEverywhere, HighGrassAndWhatStandsInItStayObstacles) {
  put_strip(0.5F, 0.03F);
  level();
  EXPECT_GE(height(kRow, kColumn), 0.5F);

  put_strip(0.2F, 0.03F);
  put(kRow + 9, kColumn, 1.0F);
  level();
  EXPECT_GE(height(kRow, kColumn), 0.2F);
}

TEST_F(GroundEverywhere, ColumnsOfTheirOwnComeToTheSameAsTheWholeFrame) {
  put_strip(0.2F, 0.03F);
  put(40, kColumn + 2, 0.1F);
  put(41, 900, 0.7F);
  level();
  const std::vector<float> whole = height_m;
  level({{0, 44}, {44, 45}, {45, kShape.columns}});
  EXPECT_EQ(height_m, whole);
}

TEST_F(GroundEverywhere, SwitchedOffNothingChanges) {
  config.enabled = false;
  rough = RoughGround(config, kObstacle_m, grid, kShape, memory);
  put(kRow, kColumn, 0.12F);
  level();
  EXPECT_EQ(height_m, z_m);
}

}  // namespace
}  // namespace terracut::elevation
