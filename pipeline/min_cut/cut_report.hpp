// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// The work of one min-cut and how far the cut got. Numbers count cells unless stated otherwise.
///
/// unknown = fixed_by_persistency + solved + certified + coarse_by_cap + coarse_by_budget. Cells of
/// the first three have the label of a global optimum; coarse cells keep the label they came with.
/// If the cut was discarded, all cells are coarse.
struct CutReport {
  std::uint32_t unknown = 0;
  std::uint32_t fixed_by_persistency = 0;  ///< Cells decided by their own excess.
  std::uint32_t solved = 0;                ///< Cells in components solved to the end.
  std::uint32_t certified = 0;             ///< Cells proven optimal in the interrupted component.
  std::uint32_t coarse_by_cap = 0;     ///< The farthest cells, beyond GridCut::Config::max_unknown.
  std::uint32_t coarse_by_budget = 0;  ///< Cells in components not solved to the end.
  /// Cells in components that stayed open for too many columns (OpenComponents) and were cut as
  /// they were; whatever the label, it is counted above.
  std::uint32_t cut_open = 0;

  std::uint32_t components = 0;         ///< Connected components left after persistency.
  std::uint32_t components_solved = 0;  ///< Number of components solved to the end.
  std::uint32_t push_relabel_runs = 0;  ///< Components too costly for Boykov-Kolmogorov.
  std::uint32_t largest_component = 0;  ///< Cells in the largest component.

  std::int64_t persistency_ops = 0;
  std::int64_t greedy_push_ops = 0;
  std::int64_t boykov_kolmogorov_ops = 0;
  std::int64_t push_relabel_ops = 0;  ///< Push-relabel's operations; count against CutBudget::ops.
  bool budget_hit = false;            ///< Operations or time ran out before the last component.
  /// True if the budget ran out before GridCut::Config::least_finished, so no label is from the
  /// cut.
  bool discarded = false;

  /// Energy E (GridProblem) of the labels returned; 0 if the cut was discarded, as weights may then
  /// be unknown. Cells beyond the cap count as hard seeds of their coarse label.
  std::int64_t energy = 0;
  /// Flow found, a lower bound of the least energy; equals `energy` if coarse_by_budget is 0. 0 if
  /// the cut was discarded.
  std::int64_t flow = 0;

  /// Returns the sum of all operations, which is the same on any machine.
  [[nodiscard]] constexpr std::int64_t operations() const noexcept {
    return persistency_ops + greedy_push_ops + boykov_kolmogorov_ops + push_relabel_ops;
  }
  /// Adds the work of another cut of the same frame, whose cells lie apart.
  CutReport& operator+=(const CutReport& other) noexcept TERRACUT_NONBLOCKING;
  /// True if every unknown cell has the label of one global optimum.
  [[nodiscard]] constexpr bool exact() const noexcept {
    return coarse_by_cap == 0 && coarse_by_budget == 0;
  }
};

}  // namespace terracut::min_cut
