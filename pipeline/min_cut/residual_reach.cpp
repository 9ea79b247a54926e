// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/residual_reach.hpp"

namespace terracut::min_cut {

std::uint32_t measure_way_to_sink(CutGraph& graph, std::span<const std::uint32_t> component,
                                  std::span<std::uint32_t> queue, std::int64_t& ops) noexcept {
  std::uint32_t end = 0;
  for (const std::uint32_t index : component) {
    CutNode& node = graph.nodes[index];
    node.distance = node.excess < 0 ? 1 : kNoWayToSink;
    if (node.excess < 0) queue[end++] = index;
  }
  for (std::uint32_t next = 0; next < end; ++next) {
    const CutNode& node = graph.nodes[queue[next]];
    const std::uint32_t distance = node.distance + 1;
    ops += std::popcount(node.edges);
    for_each_edge(node.edges, [&](int direction) {
      const std::uint32_t other = node.neighbour[static_cast<std::size_t>(direction)];
      CutNode& neighbour = graph.nodes[other];
      // A branch would be mispredicted. So the loop always writes the neighbour, but counts it only
      // if it is new.
      const bool is_new = neighbour.distance == kNoWayToSink &&
                          neighbour.residual[static_cast<std::size_t>(opposite(direction))] != 0;
      queue[end] = other;
      neighbour.distance = is_new ? distance : neighbour.distance;
      end += is_new ? 1 : 0;
    });
  }
  return end;
}

std::uint32_t certify(CutGraph& graph, std::span<const std::uint32_t> component,
                      std::span<std::uint32_t> queue) noexcept {
  std::int64_t ops = 0;
  const auto size = static_cast<std::uint32_t>(component.size());
  measure_way_to_sink(graph, component, queue, ops);

  // From here on kFree means that the source reaches the node; at the end, nodes proven to be on
  // the sink side get their label.
  std::uint32_t end = 0;
  for (const std::uint32_t index : component) {
    CutNode& node = graph.nodes[index];
    node.side = node.excess > 0 ? Side::kFree : Side::kGround;
    if (node.excess > 0) queue[end++] = index;
  }
  for (std::uint32_t next = 0; next < end; ++next) {
    const CutNode& node = graph.nodes[queue[next]];
    for_each_edge(node.edges, [&](int direction) {
      const std::uint32_t other = node.neighbour[static_cast<std::size_t>(direction)];
      CutNode& neighbour = graph.nodes[other];
      if (neighbour.side == Side::kFree) return;
      if (node.residual[static_cast<std::size_t>(direction)] == 0) return;
      neighbour.side = Side::kFree;
      queue[end++] = other;
    });
  }

  std::uint32_t unproven = 0;
  for (const std::uint32_t index : component) {
    CutNode& node = graph.nodes[index];
    if (node.distance == kNoWayToSink) node.side = Side::kObstacle;
    if (node.side == Side::kFree) ++unproven;
  }
  return size - unproven;
}

}  // namespace terracut::min_cut
