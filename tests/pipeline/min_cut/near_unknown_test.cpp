// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/near_unknown.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "rt/memory/fixed_memory.hpp"

namespace terracut::min_cut {
namespace {

constexpr frame::ImageShape kShape{5, 100};

/// The cells next to which one unknown cell is said to be.
struct NearOneUnknown : testing::Test {
  void make_unknown(int row, int column) {
    std::vector<Seed> seeds(kShape.cells(), Seed::kGround);
    seeds[kShape.cell(row, column)] = Seed::kUnknown;
    near.find(seeds);
  }
  [[nodiscard]] bool is_near(int row, int column) const {
    return near.is_near(row, {column, column + 1});
  }

  memory::FixedMemory memory;
  NearUnknown near{kShape, memory};
};

TEST_F(NearOneUnknown, IsFoundFromAllItsNeighbours) {
  for (const int row : {0, 2, 4}) {
    for (const int column : {0, 15, 16, 50, 99}) {
      make_unknown(row, column);
      for (int down = -1; down <= 1; ++down) {
        for (int right = -1; right <= 1; ++right) {
          const int from = row + down;
          if (from < 0 || from >= kShape.rows) continue;
          EXPECT_TRUE(is_near(from, (column + right + kShape.columns) % kShape.columns))
              << row << ' ' << column << ' ' << down << ' ' << right;
        }
      }
    }
  }
}

TEST_F(NearOneUnknown, IsNotFoundFromFarAway) {
  make_unknown(2, 50);
  EXPECT_FALSE(is_near(0, 50));
  EXPECT_FALSE(is_near(4, 50));
  EXPECT_FALSE(is_near(2, 20));
  EXPECT_FALSE(is_near(2, 90));
  EXPECT_FALSE(near.is_near(2, {65, 100}));
  EXPECT_TRUE(near.is_near(2, {10, 60}));
}

}  // namespace
}  // namespace terracut::min_cut
