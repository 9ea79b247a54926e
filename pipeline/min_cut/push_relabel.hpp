// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/cut_graph.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Finds the minimum cut of one component after A. V. Goldberg, R. E. Tarjan, "A New Approach to
/// the Maximum-Flow Problem", J. ACM 35(4), 1988, with the highest-label rule, the gap rule and
/// occasional exact relabelling. Slower than Boykov-Kolmogorov on street scenes but bounded, O(n^2
/// sqrt m); continues from any residual graph. Only the cut is computed: excess that cannot reach
/// the sink stays where it is, as source capacity.
class PushRelabel {
 public:
  PushRelabel(std::size_t max_nodes, memory::FixedMemory& memory);

  /// Returns true when the cut is minimal; each node of the component then has its final `side`.
  /// False when the clock's budget is reached; the residual graph stays valid. Real-time safe.
  [[nodiscard]] bool solve(CutGraph& graph, std::span<const std::uint32_t> component,
                           OpClock& clock) noexcept TERRACUT_NONBLOCKING;

 private:
  static constexpr std::uint32_t kEnd = 0xFFFFFFFF;  ///< The end of a list.

  void relabel_all(std::span<const std::uint32_t> component) noexcept;
  void discharge(std::uint32_t index) noexcept;
  void lift(std::uint32_t index, std::uint32_t distance) noexcept;

  void enter_level(std::uint32_t index) noexcept;
  void leave_level(std::uint32_t index) noexcept;
  void make_active(std::uint32_t index) noexcept;
  [[nodiscard]] std::uint32_t take_highest_active() noexcept;

  /// Lists of the nodes at each distance to the sink in [1, component size], doubly linked; nodes
  /// with excess are also on a stack for each distance.
  std::span<std::uint32_t> level_first_, level_next_, level_previous_;
  std::span<std::uint32_t> active_first_, active_next_;
  std::span<std::uint32_t> queue_;
  std::uint32_t levels_ = 0;          ///< Levels in use; all higher levels are empty.
  std::uint32_t highest_active_ = 0;  ///< No active node is above this level.

  std::span<CutNode> nodes_;    ///< Nodes of the graph being solved.
  std::int64_t ops_ = 0;        ///< Operations not yet reported to the clock.
  std::int64_t lift_work_ = 0;  ///< Operations in lifts since the last exact relabelling.
  std::int64_t flow_ = 0;
};

}  // namespace terracut::min_cut
