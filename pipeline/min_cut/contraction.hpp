// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/cut_graph.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/min_cut/unknown_cells.hpp"

namespace terracut::pipeline {

/// Builds the graph of the unknown cells. An edge to a hard seed is cut exactly when the cell gets the
/// other label, so its weight is added to the cost of that label: hard seeds never become nodes, and
/// nothing is approximated. `graph.nodes` has one node per kept cell.
template <EdgeWeights Weights>
void contract(const GridProblem& problem, const UnknownCells& unknown, const Weights& weights,
              CutGraph& graph) noexcept {
  using Lanes = std::array<std::int16_t, kDirections>;  // one SIMD register: no branch per neighbour
  const auto stride = static_cast<std::uint32_t>(problem.shape.stride());
  const auto clamped = [](std::int32_t cost) { return std::clamp(cost, 0, kMaxTerminalCost); };
  const std::span<const std::uint32_t> cells = unknown.cells();
  graph.flow = 0;

  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t cell = cells[i];
    const int row = static_cast<int>(cell / stride);
    const int column = static_cast<int>(cell % stride);
    const NeighbourCells around = neighbour_cells(problem.shape, row, column);
    std::array<std::uint16_t, kDirections> weight;
    weights(cell, around, std::span<std::uint16_t, kDirections>(weight));

    Lanes seed;
    for (std::size_t d = 0; d < kDirections; ++d) {
      seed[d] = static_cast<std::int16_t>(problem.seeds[around[d]]);
    }
    const unsigned outside = outside_rows(problem.shape, row);
    if (outside != 0) [[unlikely]] {
      for_each_edge(static_cast<std::uint8_t>(outside), [&](int d) {
        seed[static_cast<std::size_t>(d)] = static_cast<std::int16_t>(Seed::kNone);
      });
    }

    CutNode& node = graph.nodes[i];
    int to_ground = 0, to_obstacle = 0;
    unsigned edges = 0;
    for (std::size_t d = 0; d < kDirections; ++d) {
      const int w = std::min<int>(weight[d], kMaxEdgeWeight);
      const bool open = seed[d] == static_cast<std::int16_t>(Seed::kUnknown) && w > 0;
      to_ground += seed[d] == static_cast<std::int16_t>(Seed::kGround) ? w : 0;
      to_obstacle += seed[d] == static_cast<std::int16_t>(Seed::kObstacle) ? w : 0;
      node.residual[d] = static_cast<std::int16_t>(open ? w : 0);
      edges |= (open ? 1U : 0U) << d;
    }
    for (unsigned left = edges; left != 0; left &= left - 1) {
      const auto d = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t other = unknown.node_of(around[d]);
      node.neighbour[d] = other;
      if (other < UnknownCells::kPinnedGround) [[likely]] continue;
      (other == UnknownCells::kPinnedGround ? to_ground : to_obstacle) += node.residual[d];
      node.residual[d] = 0;
      edges &= ~(1U << d);
    }

    const std::int32_t ground = clamped(problem.cost_ground[cell]) + to_obstacle;
    const std::int32_t obstacle = clamped(problem.cost_obstacle[cell]) + to_ground;
    graph.flow += std::min(ground, obstacle);
    node.excess = ground - obstacle;
    node.edges = static_cast<std::uint8_t>(edges);
    node.side = Side::kFree;
  }
}

}  // namespace terracut::pipeline
