// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/lone_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/synthetic_frame.hpp"

namespace terracut::elevation {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

struct LoneReturnsOfARow : testing::Test {
  static constexpr frame::ImageShape kShape{64, 200};

  LoneReturnsOfARow()
      : grid({}, test::even_profile(), kShape, memory), stage(0.1F, grid, kShape, memory) {}
  /// The columns that are alone.
  std::vector<int> lone(const std::vector<float>& z_m) {
    std::vector<float> kept_m(z_m.size());
    stage.take_out(z_m.data(), {0, kShape.columns}, kept_m);
    std::vector<int> columns;
    for (std::size_t i = 0; i < z_m.size(); ++i) {
      if (std::isnan(kept_m[i]) && !std::isnan(z_m[i])) columns.push_back(static_cast<int>(i));
      if (!std::isnan(kept_m[i])) {
        EXPECT_EQ(kept_m[i], z_m[i]);
      }
    }
    return columns;
  }
  memory::FixedMemory memory;
  RingGrid grid;
  LoneReturns stage;
  std::vector<float> ground = std::vector<float>(200, -1.7F);
};

TEST_F(LoneReturnsOfARow, AGhostBelowTheRoadIsAlone) {
  ground[25] = -2.3F;
  ground[33] = -1.85F;
  EXPECT_EQ(lone(ground), (std::vector{25, 33}));
}

TEST_F(LoneReturnsOfARow, GroundInADitchHasCompany) {
  for (const int column : {24, 25, 26}) ground[static_cast<std::size_t>(column)] = -2.3F;
  EXPECT_TRUE(lone(ground).empty());
}

TEST_F(LoneReturnsOfARow, WhatIsHigherThanTheRowIsNotAlone) {
  ground[25] = -0.5F;  // a pole
  EXPECT_TRUE(lone(ground).empty());
}

TEST_F(LoneReturnsOfARow, NoiseAndARoughRoadAreNotAlone) {
  for (std::size_t i = 0; i < ground.size(); ++i) ground[i] += i % 3 == 0 ? -0.06F : 0.03F;
  EXPECT_TRUE(lone(ground).empty());
}

TEST_F(LoneReturnsOfARow, ReturnsOfAnotherSectorAreNotCompared) {
  const int last = grid.columns_of({3, 4}).end - 1;
  for (int column = 0; column < kShape.columns; ++column) {
    if (column != last) ground[static_cast<std::size_t>(column)] = kNone;
  }
  ground[static_cast<std::size_t>(last)] = -2.3F;
  ground[static_cast<std::size_t>(last) + 1] = -1.7F;
  EXPECT_TRUE(lone(ground).empty());
  ground[static_cast<std::size_t>(last) - 1] = -1.7F;
  EXPECT_EQ(lone(ground), std::vector{last});
}

TEST_F(LoneReturnsOfARow, SectorsThatArriveOneByOneGiveWhatTheWholeRowGives) {
  for (std::size_t i = 0; i < ground.size(); ++i) {
    ground[i] = i % 7 == 0 ? kNone : -1.7F - (i % 5 == 0 ? 0.3F : 0.0F);
  }
  std::vector<float> whole(ground.size()), part(ground.size());
  stage.take_out(ground.data(), {0, kShape.columns}, whole);
  for (int sector = 0; sector < grid.sectors(); ++sector) {
    const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
    // What has not arrived may not be read.
    std::vector<float> arrived(ground.begin(), ground.begin() + columns.end);
    stage.take_out(arrived.data(), columns, part);
    for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
      const float expected = whole[static_cast<std::size_t>(columns.begin + i)];
      const float found = part[static_cast<std::size_t>(i)];
      EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected))) << sector;
    }
  }
}

}  // namespace
}  // namespace terracut::elevation
