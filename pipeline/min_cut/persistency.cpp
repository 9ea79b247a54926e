// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/persistency.hpp"

#include "pipeline/min_cut/eight_lanes.hpp"

namespace terracut::min_cut {

Persistency::Persistency(std::size_t max_nodes, memory::FixedMemory& memory)
    : worklist_(memory.take<std::uint32_t>("min-cut: work lists", max_nodes)) {}

void Persistency::decide(CutNode& node, std::uint32_t index) noexcept {
  const int capacity = EightLanes::load(node.residual).sum();
  if (node.excess >= capacity) {
    node.side = Side::kObstacle;
  } else if (-node.excess > capacity) {
    node.side = Side::kGround;
  } else {
    return;
  }
  worklist_[worklist_size_++] = index;  // each node at most once: only free nodes come here
}

Persistency::Result Persistency::fix(CutGraph& graph, OpClock& clock) noexcept {
  constexpr std::uint32_t kPerLook = CutBudget::kNodesPerClockLook;
  Result result;
  worklist_size_ = 0;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    if (i % kPerLook == 0 && clock.expired()) return result;
    decide(graph.nodes[i], i);
  }

  while (result.fixed < worklist_size_) {
    if (result.fixed % kPerLook == 0 && clock.expired()) return result;
    CutNode& node = graph.nodes[worklist_[result.fixed++]];
    for_each_edge(node.edges, [&](int direction) {
      const auto d = static_cast<std::size_t>(direction);
      const auto back = static_cast<std::size_t>(opposite(direction));
      CutNode& neighbour = graph.nodes[node.neighbour[d]];
      const int weight = node.residual[d];
      ++result.ops;
      neighbour.edges = static_cast<std::uint8_t>(neighbour.edges & ~(1U << back));
      neighbour.residual[back] = 0;
      graph.flow += add_excess(neighbour, node.side == Side::kObstacle ? weight : -weight);
      if (neighbour.side == Side::kFree) decide(neighbour, node.neighbour[d]);
    });
    node.edges = 0;
  }
  result.finished = true;
  return result;
}

}  // namespace terracut::min_cut
