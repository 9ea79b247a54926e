// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/cut_graph.hpp"
#include "pipeline/min_cut/node_queue.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Finds the maximum flow of one component after Y. Boykov, V. Kolmogorov, "An Experimental
/// Comparison of Min-Cut/Max-Flow Algorithms for Energy Minimization in Vision", PAMI 26(9), 2004,
/// section 3. Two search trees, one from each terminal, grow until they touch; flow is pushed along
/// the path; the nodes that this cuts off are adopted by other parents or set free. It is the
/// fastest solver on street scenes, but has no useful bound: give it a budget.
class BoykovKolmogorov {
 public:
  BoykovKolmogorov(std::size_t max_nodes, memory::FixedMemory& memory);

  /// Returns true when the flow is maximal; each node of the component then has its final `side`.
  /// False when `ops_limit` (of clock.ops()) or the clock's own budget is reached: any other solver
  /// can then continue from the residual graph; `side` is meaningless. Real-time safe.
  [[nodiscard]] bool solve(CutGraph& graph, std::span<const std::uint32_t> component,
                           OpClock& clock, std::int64_t ops_limit) noexcept TERRACUT_NONBLOCKING;

 private:
  /// Values of CutNode::parent that are not directions.
  static constexpr std::uint8_t kParentTerminal = 8;
  static constexpr std::uint8_t kParentNone = 9;  ///< The node is an orphan or in no tree.

  /// An arc that connects the trees, from a node of the source tree to one of the sink tree.
  struct Bridge {
    std::uint32_t from;
    int direction;  ///< Negative: no bridge.
  };

  void plant(std::span<const std::uint32_t> component) noexcept;
  [[nodiscard]] Bridge grow(std::uint32_t index) noexcept;
  void augment(const Bridge& bridge) noexcept;
  void adopt(std::uint32_t orphan) noexcept;

  /// Returns the capacity from parent to child in the direction of flow: source trees point
  /// outwards, sink trees inwards.
  [[nodiscard]] static int tree_capacity(const CutNode& parent, const CutNode& child,
                                         int child_to_parent) noexcept;
  /// Returns the number of edges from `index` to its terminal; 0 if the path ends at an orphan.
  [[nodiscard]] std::uint32_t origin_distance(std::uint32_t index) noexcept;
  void activate(std::uint32_t index) noexcept;
  void cut_off(std::uint32_t index) noexcept;
  [[nodiscard]] CutNode& node(std::uint32_t index) noexcept { return nodes_[index]; }

  NodeQueue active_, orphans_;
  std::span<CutNode> nodes_;  ///< Nodes of the graph being solved.
  std::uint32_t time_ = 0;    ///< Number of augmentations so far.
  std::int64_t ops_ = 0;
  std::int64_t flow_ = 0;
};

}  // namespace terracut::min_cut
