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
#include "pipeline/min_cut/push_relabel.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Minimises GridProblem's energy exactly. If the budget runs out, unfinished components keep
/// coarse labels, which are counted. The energy is never above that of the coarse labels; if too
/// little is finished, all labels stay coarse.
///
/// Of all labellings of least energy it returns the one with the most obstacle cells (there is
/// exactly one: the largest source side). So the labels of a finished component depend on the
/// problem alone, not on the solver, the order of work or the budget.
///
/// All memory is taken in the constructor. One instance per thread; solve() is real-time safe.
class GridCut {
 public:
  struct Config {
    /// The most unknown cells that persistency may leave to the solvers; bounds memory and time.
    /// When there are more, cells of higher rows keep their coarse label.
    std::uint32_t max_unknown = 16'384;
    /// Boykov-Kolmogorov begins components of up to this many nodes, push-relabel larger ones:
    /// rough ground leaves some of 1,000 nodes and more.
    std::uint32_t bk_most_nodes = 64;
    /// If Boykov-Kolmogorov needs more operations for a component than `bk_ops_per_node` * its
    /// nodes
    /// + `bk_ops_base`, push-relabel finishes it. Both are in [0, 1e9].
    std::int64_t bk_ops_per_node = 100;
    std::int64_t bk_ops_base = 20'000;
    /// Least share of unknown cells that must be finished (fixed or in solved components) when the
    /// budget runs out, [0, 1]; with less, all cells keep their coarse label.
    float least_finished = 0.5F;
  };

  /// Needs shape.columns >= 3 and shape.rows >= 1. Throws std::invalid_argument when the shape or
  /// `config` is out of range (start-up only).
  GridCut(const frame::ImageShape& shape, const Config& config, memory::FixedMemory& memory);

  /// Labels the unknown cells of the window. On entry `labels` has the coarse label of each
  /// (anything but kObstacle counts as ground), on return its final one; other cells are not
  /// changed. `problem.shape` must be the constructor's. Each formerly unknown cell of
  /// `problem.seeds` is then decided or pinned to its coarse label. Real-time safe.
  template <RegionCosts Costs, EdgeWeights Weights>
  [[gnu::always_inline, nodiscard]] CutReport solve(const GridProblem& problem, const Costs& costs,
                                                    const Weights& weights, const CutBudget& budget,
                                                    std::span<frame::Label> labels) noexcept {
    OpClock clock(budget);
    const Contraction::Result contracted =
        contraction_.run(problem, costs, weights, labels, clock, graph_);
    return solve_contracted(problem, contracted, clock, labels);
  }

 private:
  [[nodiscard]] CutReport solve_contracted(
      const GridProblem& problem, const Contraction::Result& contracted, OpClock& clock,
      std::span<frame::Label> labels) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] bool is_worth_keeping(const CutReport& report) const noexcept;
  /// Leaves all cells coarse, and returns the report of that.
  [[nodiscard]] static CutReport discard(const GridProblem& problem,
                                         std::span<const frame::Label> labels,
                                         CutReport report) noexcept TERRACUT_NONBLOCKING;

  /// Solves one component. Returns false if the budget ran out before the end.
  [[nodiscard]] bool solve_component(std::span<const std::uint32_t> component, OpClock& clock,
                                     CutReport& report) noexcept;
  /// Labels the nodes of an unfinished component whose side can be proven, leaves the others
  /// coarse, and returns the labels' cost beyond the flow.
  [[nodiscard]] std::int64_t finalize_unfinished(std::span<const std::uint32_t> component,
                                                 bool started, std::span<const frame::Label> labels,
                                                 std::span<Seed> seeds, CutReport& report) noexcept;
  /// Writes a node's side to the seed of its cell.
  void decide(std::uint32_t index, std::span<Seed> seeds) const noexcept;

  Config config_;
  Contraction contraction_;
  CutGraph graph_;
  std::span<std::uint32_t> queue_;
  Components components_;
  BoykovKolmogorov boykov_kolmogorov_;
  PushRelabel push_relabel_;
};

}  // namespace terracut::min_cut
