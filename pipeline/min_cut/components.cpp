// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/components.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace terracut::min_cut {
namespace {

/// Returns bits that as integers have the same order as non-negative floats; NaN comes last.
std::uint32_t ordered_bits(float range_m) noexcept {
  return range_m < 0 ? 0U : std::bit_cast<std::uint32_t>(range_m + 0.0F) & 0x7FFFFFFFU;
}

}  // namespace

Components::Components(std::size_t max_nodes, memory::FixedMemory& memory)
    : nodes_(memory.take<std::uint32_t>("min-cut: components", max_nodes + 1)),
      extents_(memory.take<Extent>("min-cut: components", max_nodes)) {}

std::span<const std::uint32_t> Components::operator[](std::uint32_t i) const noexcept {
  return nodes_.subspan(extents_[i].begin, extents_[i].end - extents_[i].begin);
}

void Components::find(CutGraph& graph, std::span<const std::uint32_t> cells,
                      std::span<const float> ground_range_m) noexcept {
  // While components are searched, `queued` means that a node was reached.
  for (CutNode& node : graph.nodes) node.queued = node.side != Side::kFree;
  count_ = 0;
  std::uint32_t end = 0;
  for (std::uint32_t seed = 0; seed < graph.nodes.size(); ++seed) {
    if (graph.nodes[seed].queued) continue;
    Extent extent{0xFFFFFFFFU, end, end};
    const auto reach = [&](std::uint32_t index) {
      graph.nodes[index].queued = true;
      nodes_[end++] = index;
    };
    reach(seed);
    for (std::uint32_t next = extent.begin; next < end; ++next) {
      const CutNode& node = graph.nodes[nodes_[next]];
      extent.range_bits =
          std::min(extent.range_bits, ordered_bits(ground_range_m[cells[nodes_[next]]]));
      for_each_edge(node.edges, [&](int direction) {
        const std::uint32_t neighbour = node.neighbour[static_cast<std::size_t>(direction)];
        // A branch would be mispredicted. So the loop always writes the neighbour, but counts it
        // only if it was not reached before.
        bool& reached = graph.nodes[neighbour].queued;
        nodes_[end] = neighbour;
        end += reached ? 0 : 1;
        reached = true;
      });
    }
    extent.end = end;
    extents_[count_++] = extent;
  }
  std::sort(extents_.begin(), extents_.begin() + count_, [](const Extent& a, const Extent& b) {
    return std::tie(a.range_bits, a.begin) < std::tie(b.range_bits, b.begin);
  });
}

}  // namespace terracut::min_cut
