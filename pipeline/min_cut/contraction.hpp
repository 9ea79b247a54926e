// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/cut_graph.hpp"
#include "pipeline/min_cut/eight_lanes.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/min_cut/unknown_cells.hpp"

namespace terracut::min_cut {

/// The seeds of the neighbours, one a lane; away from the image's edges by three loads.
[[nodiscard]] inline EightLanes seeds_around(std::span<const Seed> seeds,
                                             const NeighbourCells& around) noexcept {
  if (are_next_to_each_other(around)) [[likely]] {
    std::uint32_t below, beside, above;
    std::memcpy(&below, &seeds[around[0]], sizeof(below));
    std::memcpy(&beside, &seeds[around[3]], sizeof(beside));
    std::memcpy(&above, &seeds[around[5] - 1], sizeof(above));
    return {EightLanes::widened((below & 0xFF'FFFFU) | beside << 24U),
            EightLanes::widened((beside >> 16U & 0xFFU) | (above & 0xFFFF'FF00U))};
  }
  EightLanes lanes;
  for (std::size_t d = 0; d < 4; ++d) {
    lanes.low |= static_cast<std::uint64_t>(seeds[around[d]]) << (16 * d);
    lanes.high |= static_cast<std::uint64_t>(seeds[around[d + 4]]) << (16 * d);
  }
  return lanes;
}

/// One node of contract().
inline void contract_cell(const GridProblem& problem, const UnknownCells& unknown,
                          std::uint32_t cell, int row, const NeighbourCells& around,
                          const std::array<std::uint16_t, kDirections>& weight, CutNode& node,
                          std::int64_t& flow) noexcept {
  EightLanes w;
  for (std::size_t d = 0; d < 4; ++d) {
    const auto allowed = [](std::uint16_t given) {
      return std::min<std::uint64_t>(given, kMaxEdgeWeight);
    };
    w.low |= allowed(weight[d]) << (16 * d);
    w.high |= allowed(weight[d + 4]) << (16 * d);
  }
  EightLanes seed = seeds_around(problem.seeds, around);
  if (row == 0) seed.low &= ~std::uint64_t{0xFFFF'FFFF'FFFF};             // directions 0, 1, 2
  if (row + 1 == problem.shape.rows) seed.high &= std::uint64_t{0xFFFF};  // directions 5, 6, 7

  const auto bit_of = [](Seed value) { return std::countr_zero(static_cast<unsigned>(value)); };
  const EightLanes open = w.where(seed, bit_of(Seed::kUnknown));
  int to_ground = w.where(seed, bit_of(Seed::kGround)).sum();
  int to_obstacle = w.where(seed, bit_of(Seed::kObstacle)).sum();
  open.store(node.residual);
  unsigned edges = open.nonzero();
  for (std::size_t d = 0; d < around.size(); ++d) node.neighbour[d] = unknown.node_of(around[d]);
  if (unknown.has_pinned()) [[unlikely]] {
    for (unsigned left = edges; left != 0; left &= left - 1) {
      const auto d = static_cast<std::size_t>(std::countr_zero(left));
      if (node.neighbour[d] < UnknownCells::kPinnedGround) continue;
      (node.neighbour[d] == UnknownCells::kPinnedGround ? to_ground : to_obstacle) +=
          node.residual[d];
      node.residual[d] = 0;
      edges &= ~(1U << d);
    }
  }

  const auto clamped = [](std::int32_t cost) { return std::clamp(cost, 0, kMaxTerminalCost); };
  const std::int32_t cost_ground = clamped(problem.cost_ground[cell]) + to_obstacle;
  const std::int32_t cost_obstacle = clamped(problem.cost_obstacle[cell]) + to_ground;
  flow += std::min(cost_ground, cost_obstacle);
  node.excess = cost_ground - cost_obstacle;
  node.edges = static_cast<std::uint8_t>(edges);
  node.side = Side::kFree;
}

/// Builds the graph of the unknown cells. An edge to a hard seed is cut exactly when the cell gets
/// the other label, so its weight is added to the cost of that label: hard seeds never become
/// nodes, and nothing is approximated. `graph.nodes` has one node per kept cell. False when the
/// caller's clock expired first: the graph is not whole then.
template <EdgeWeights Weights>
[[nodiscard]] bool contract(const GridProblem& problem, const UnknownCells& unknown,
                            const Weights& weights, OpClock& clock, CutGraph& graph) noexcept {
  const std::span<const std::uint32_t> cells = unknown.cells();
  const auto stride = static_cast<std::uint32_t>(problem.shape.stride());
  std::uint32_t row = 0;
  graph.flow = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i % CutBudget::kNodesPerClockLook == 0 && clock.expired()) return false;
    const std::uint32_t cell = cells[i];
    while (cell >= (row + 1) * stride) ++row;
    const auto column = static_cast<int>(cell - row * stride);
    const NeighbourCells around = neighbour_cells(problem.shape, static_cast<int>(row), column);
    std::array<std::uint16_t, kDirections> weight;
    weights(cell, around, std::span<std::uint16_t, kDirections>(weight));
    contract_cell(problem, unknown, cell, static_cast<int>(row), around, weight, graph.nodes[i],
                  graph.flow);
  }
  return true;
}

}  // namespace terracut::min_cut
