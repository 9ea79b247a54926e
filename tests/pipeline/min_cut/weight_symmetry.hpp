// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "pipeline/min_cut/grid_problem.hpp"

namespace terracut::test {

/// Checks what GridCut asks of every EdgeWeights: between cells that are no holes, the weight is
/// the same both ways, bit for bit, and at most kMaxEdgeWeight.
template <min_cut::EdgeWeights Weights>
void expect_symmetric_weights(const frame::ImageShape& shape, std::span<const min_cut::Seed> seeds,
                              const Weights& weights) {
  using Eight = std::array<std::uint16_t, min_cut::kDirections>;
  const auto cell_of = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * shape.stride() + column);
  };
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const std::uint32_t p = cell_of(row, column);
      if (seeds[p] == min_cut::Seed::kNone) continue;
      const min_cut::NeighbourCells around = min_cut::neighbour_cells(shape, row, column);
      Eight there{};
      weights(p, around, there);
      for (std::size_t d = 0; d < min_cut::kDirections; ++d) {
        const std::uint32_t q = around[d];
        if (q == p || seeds[q] == min_cut::Seed::kNone) continue;
        const int other_row = static_cast<int>(q) / shape.stride();
        const int other_column = static_cast<int>(q) % shape.stride();
        Eight back{};
        weights(q, min_cut::neighbour_cells(shape, other_row, other_column), back);
        ASSERT_EQ(there[d], back[static_cast<std::size_t>(min_cut::opposite(static_cast<int>(d)))])
            << "cells " << p << " and " << q;
        ASSERT_LE(there[d], min_cut::kMaxEdgeWeight) << "cells " << p << " and " << q;
      }
    }
  }
}

}  // namespace terracut::test
