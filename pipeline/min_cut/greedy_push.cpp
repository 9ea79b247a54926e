// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/greedy_push.hpp"

#include <algorithm>

namespace terracut::min_cut {

std::int64_t push_one_hop(CutGraph& graph) noexcept {
  std::int64_t ops = 0;
  for (CutNode& node : graph.nodes) {
    if (node.excess <= 0) continue;
    for_each_edge(node.edges, [&](int direction) {
      const auto d = static_cast<std::size_t>(direction);
      CutNode& neighbour = graph.nodes[node.neighbour[d]];
      ++ops;
      const int amount =
          std::min({node.excess, int{node.residual[d]}, std::max(0, -neighbour.excess)});
      push_along(node, neighbour, direction, amount);
      node.excess -= amount;
      neighbour.excess += amount;
      graph.flow += amount;
    });
  }
  return ops;
}

}  // namespace terracut::min_cut
