// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/min_cut/boykov_kolmogorov.hpp"
#include "pipeline/min_cut/components.hpp"
#include "pipeline/min_cut/contraction.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/cut_graph.hpp"
#include "pipeline/min_cut/cut_report.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/min_cut/persistency.hpp"
#include "pipeline/min_cut/push_relabel.hpp"
#include "pipeline/min_cut/unknown_cells.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// The minimum of GridProblem's energy: exact, or, when the budget runs out, exact where finished
/// and coarse, listed and counted elsewhere. At no point is its energy above that of the coarse
/// labels; where too little is finished, these are the result.
///
/// Among labellings of equal energy it returns the one with the most obstacle cells (there is
/// exactly one: the largest source side). So the labels of a finished component depend on the
/// problem alone, not on the solver, the order of work or the budget.
///
/// All memory is taken in the constructor. One instance per thread; solve() is real-time safe.
class GridCut {
 public:
  struct Config {
    /// Unknown cells solved at most; beyond, the farthest keep their coarse label. Bounds the time.
    std::uint32_t max_unknown = 16'384;
    /// A component that takes Boykov-Kolmogorov more operations than
    /// `bk_ops_per_node` * its nodes + `bk_ops_base` is finished by push-relabel. Each in [0, 1e9].
    std::int64_t bk_ops_per_node = 100;
    std::int64_t bk_ops_base = 20'000;
    /// Share of the unknown cells solved that must be finished (fixed or in solved components) when
    /// the budget runs out; with less, all of them keep their coarse label. [0, 1].
    float least_finished = 0.5F;
  };

  /// shape.columns >= 3 and shape.rows >= 1. Throws std::invalid_argument when these or the config
  /// are out of range (start-up only).
  GridCut(const frame::ImageShape& shape, const Config& config, memory::FixedMemory& memory);

  /// Labels the unknown cells. `labels`: on entry the coarse label of every unknown cell (anything
  /// but kObstacle counts as ground), on return its final one; other cells are left as they are.
  /// `problem.shape` must be the constructor's. Real-time safe.
  template <EdgeWeights Weights>
  [[nodiscard]] CutReport solve(const GridProblem& problem, const Weights& weights,
                                const CutBudget& budget, std::span<frame::Label> labels) noexcept {
    OpClock clock(budget);
    const CutReport report = find_unknown(problem, labels);
    if (!contract(problem, unknown_, weights, clock, graph_)) return discard(report);
    return solve_contracted(problem, clock, labels, report);
  }

  /// The cells the last solve() left coarse: first those beyond the cap in row-major order, then
  /// those the budget did not reach, nearest component first, or where the cut was discarded all
  /// others in row-major order.
  [[nodiscard]] std::span<const std::uint32_t> coarse_cells() const noexcept {
    return coarse_.view();
  }

 private:
  /// Counts them.
  [[nodiscard]] CutReport find_unknown(const GridProblem& problem,
                                       std::span<const frame::Label> labels) noexcept
      TERRACUT_NONBLOCKING;
  [[nodiscard]] CutReport solve_contracted(const GridProblem& problem, OpClock& clock,
                                           std::span<frame::Label> labels,
                                           CutReport report) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] bool is_worth_keeping(const CutReport& report) const noexcept;
  /// What `report` says once the labels stay as they came.
  [[nodiscard]] CutReport discard(CutReport report) noexcept TERRACUT_NONBLOCKING;

  /// False when the budget ran out before the end.
  [[nodiscard]] bool solve_component(std::span<const std::uint32_t> component, OpClock& clock,
                                     CutReport& report) noexcept;
  /// Proves what it can of an unfinished component, leaves the rest coarse, and returns what the
  /// labels cost beyond the flow.
  [[nodiscard]] std::int64_t finalize_unfinished(std::span<const std::uint32_t> component,
                                                 bool started, std::span<const frame::Label> labels,
                                                 CutReport& report) noexcept;

  Config config_;
  UnknownCells unknown_;
  CellList coarse_;
  std::span<CutNode> node_storage_;
  std::span<std::uint32_t> queue_;
  CutGraph graph_;
  Persistency persistency_;
  Components components_;
  BoykovKolmogorov boykov_kolmogorov_;
  PushRelabel push_relabel_;
};

}  // namespace terracut::min_cut
