// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/contraction.hpp"

namespace terracut::min_cut {

Contraction::Contraction(const frame::ImageShape& shape, std::size_t max_nodes,
                         memory::FixedMemory& memory)
    : columns_(shape.columns),
      nodes_(memory.take<CutNode>("min-cut: nodes", max_nodes)),
      cells_(memory.take<std::uint32_t>("min-cut: nodes", max_nodes)),
      worklist_(memory.take<std::uint32_t>("min-cut: work lists", max_nodes)) {
  for (std::span<std::uint32_t>& row : node_in_row_) {
    row = memory.take<std::uint32_t>("min-cut: nodes", static_cast<std::size_t>(columns_));
  }
}

void Contraction::begin(const GridProblem& problem, OpClock& clock) noexcept {
  seeds_ = problem.seeds;
  clock_ = &clock;
  size_ = work_ = 0;
  is_stopped_ = false;
  flow_ = 0;
  result_ = {};
  rows_ = problem.shape.rows;
}

void Contraction::begin_row(int row) noexcept {
  here_ = node_in_row_[static_cast<std::size_t>(row % 2)];
  below_ = node_in_row_[static_cast<std::size_t>((row + 1) % 2)];
  inside_.lanes = ~EightLanes::Numbers{};
  if (row == 0) inside_.lanes &= EightLanes::Numbers{0, 0, 0, -1, -1, -1, -1, -1};
  if (row + 1 == rows_) inside_.lanes &= EightLanes::Numbers{-1, -1, -1, -1, -1, 0, 0, 0};
}

void Contraction::tell_nodes_before(int column, unsigned edges, Side side) noexcept {
  std::uint32_t waiting = 0;
  const auto close_edge = [&](std::uint32_t index, int direction, Side other) noexcept {
    CutNode& node = nodes_[index];
    const auto d = static_cast<std::size_t>(direction);
    const int weight = node.residual[d];
    node.residual[d] = 0;
    node.edges = static_cast<std::uint8_t>(node.edges & ~(1U << d));
    flow_ += add_excess(node, other == Side::kObstacle ? weight : -weight);
    ++result_.ops;
    if (node.side != Side::kFree) return;
    node.side = persistent_side(node.excess, EightLanes::load(node.residual).sum());
    if (node.side != Side::kFree) worklist_[waiting++] = index;
  };

  for_each_edge(static_cast<std::uint8_t>(edges), [&](int direction) {
    close_edge(node_before(column, direction), opposite(direction), side);
  });
  while (waiting > 0 && has_time()) {
    const std::uint32_t index = worklist_[--waiting];
    CutNode& node = nodes_[index];
    seeds_[cells_[index]] = decided(node.side);
    ++result_.decided;
    for_each_edge(node.edges, [&](int direction) {
      const std::uint32_t other = node.neighbour[static_cast<std::size_t>(direction)];
      if (other != index) close_edge(other, opposite(direction), node.side);
    });
    node.edges = 0;
  }
}

}  // namespace terracut::min_cut
