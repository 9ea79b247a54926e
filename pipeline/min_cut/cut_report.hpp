// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::min_cut {

/// What one min-cut did and how far it got. Counts are of cells unless named otherwise.
///
/// unknown = fixed_by_persistency + solved + certified + coarse_by_cap + coarse_by_budget
/// The first three carry the label of a global optimum, the coarse ones the label they came with.
/// Where the cut was discarded those are all.
struct CutReport {
  std::uint32_t unknown = 0;
  std::uint32_t fixed_by_persistency = 0;  ///< Decided by their own excess alone.
  std::uint32_t solved = 0;                ///< In components solved to the end.
  std::uint32_t certified = 0;         ///< Proven optimal in the component the budget interrupted.
  std::uint32_t coarse_by_cap = 0;     ///< Beyond GridCut::Config::max_unknown, farthest first.
  std::uint32_t coarse_by_budget = 0;  ///< In components not solved to the end.

  std::uint32_t components = 0;         ///< Connected components left after persistency.
  std::uint32_t components_solved = 0;  ///< Of them, solved to the end.
  std::uint32_t push_relabel_runs =
      0;  ///< Components too large for Boykov-Kolmogorov, or too dear.
  std::uint32_t largest_component = 0;  ///< Cells.

  std::int64_t persistency_ops = 0;
  std::int64_t greedy_push_ops = 0;
  std::int64_t boykov_kolmogorov_ops = 0;
  std::int64_t push_relabel_ops = 0;  ///< The last two count against CutBudget::ops.
  bool budget_hit = false;            ///< Operations or clock ran out before the last component.
  /// They ran out before GridCut::Config::least_finished: nothing of the cut is in the labels.
  bool discarded = false;

  /// GridProblem's E of the labels returned; 0 where the cut was discarded, because not even the
  /// weights need be known then. Cells beyond the cap count as hard seeds of their coarse label.
  std::int64_t energy = 0;
  /// Flow found, a lower bound of the least energy; equal to `energy` when nothing is coarse by
  /// budget. 0 where the cut was discarded.
  std::int64_t flow = 0;

  /// All of them: what the cut cost, whatever machine it ran on.
  [[nodiscard]] constexpr std::int64_t operations() const noexcept {
    return persistency_ops + greedy_push_ops + boykov_kolmogorov_ops + push_relabel_ops;
  }
  /// Every unknown cell carries the label of one global optimum.
  [[nodiscard]] constexpr bool exact() const noexcept {
    return coarse_by_cap == 0 && coarse_by_budget == 0;
  }
};

}  // namespace terracut::min_cut
