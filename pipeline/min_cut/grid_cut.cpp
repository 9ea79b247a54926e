// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/grid_cut.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "pipeline/min_cut/greedy_push.hpp"
#include "pipeline/min_cut/residual_reach.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::min_cut {
namespace {

GridCut::Config checked(const frame::ImageShape& shape, GridCut::Config config) {
  if (shape.columns < 3 || shape.rows < 1) {
    throw std::invalid_argument("GridCut expects at least 3 columns (they are cyclic) and 1 row");
  }
  constexpr std::int64_t kMostOps = 1'000'000'000;
  for (const std::int64_t ops : {config.bk_ops_per_node, config.bk_ops_base}) {
    if (ops < 0 || ops > kMostOps) {
      throw std::invalid_argument("GridCut expects bk_ops_per_node and bk_ops_base in [0, 1e9]");
    }
  }
  if (!(config.least_finished >= 0 && config.least_finished <= 1)) {
    throw std::invalid_argument("GridCut expects least_finished in [0, 1]");
  }
  config.max_unknown = static_cast<std::uint32_t>(
      std::min<std::size_t>(config.max_unknown, shape.cells()));  // more nodes are never needed
  return config;
}

/// Returns the cost in the residual graph of the labels in `side`: the terminal capacities and arcs
/// that these labels cut.
std::int64_t residual_cost(const CutGraph& graph,
                           std::span<const std::uint32_t> component) noexcept {
  std::int64_t cost = 0;
  for (const std::uint32_t index : component) {
    const CutNode& node = graph.nodes[index];
    if (node.side == Side::kGround) {
      cost += std::max(node.excess, 0);
      continue;
    }
    cost += std::max(-node.excess, 0);
    for_each_edge(node.edges, [&](int direction) {
      const auto d = static_cast<std::size_t>(direction);
      if (graph.nodes[node.neighbour[d]].side == Side::kGround) cost += node.residual[d];
    });
  }
  return cost;
}

Seed pinned_to(frame::Label label) noexcept {
  return label == frame::Label::kObstacle ? Seed::kPinnedObstacle : Seed::kPinnedGround;
}

/// Calls `visit(first cell, number of cells)` for the cells of each row of the problem's window.
template <class Visit>
void for_each_row_piece(const GridProblem& problem, Visit visit) noexcept {
  for (int row = 0; row < problem.shape.rows; ++row) {
    problem.window.for_each_range(problem.shape.columns, [&](frame::ColumnRange columns) {
      visit(problem.shape.cell(row, columns.begin), columns.size());
    });
  }
}

/// Labels decided cells; others keep their label.
TERRACUT_VECTOR_CLONES void take_decisions(std::span<const Seed> seeds,
                                           std::span<frame::Label> labels) noexcept {
  static_assert(static_cast<int>(Seed::kGround) == static_cast<int>(frame::Label::kGround) &&
                static_cast<int>(Seed::kObstacle) == static_cast<int>(frame::Label::kObstacle));
  const std::size_t cells = labels.size();
  const Seed* const __restrict seed = seeds.data();
  frame::Label* const __restrict label = labels.data();
  constexpr auto kSides =
      static_cast<std::uint8_t>(Seed::kGround) | static_cast<std::uint8_t>(Seed::kObstacle);
  for (std::size_t i = 0; i < cells; ++i) {
    const auto bits = static_cast<std::uint8_t>(seed[i]);
    const auto side = static_cast<frame::Label>(bits & kSides);
    label[i] = (bits & static_cast<std::uint8_t>(Seed::kDecided)) != 0 ? side : label[i];
  }
}

}  // namespace

CutReport& CutReport::operator+=(const CutReport& other) noexcept {
  unknown += other.unknown;
  fixed_by_persistency += other.fixed_by_persistency;
  solved += other.solved;
  certified += other.certified;
  coarse_by_cap += other.coarse_by_cap;
  coarse_by_budget += other.coarse_by_budget;
  cut_open += other.cut_open;
  components += other.components;
  components_solved += other.components_solved;
  push_relabel_runs += other.push_relabel_runs;
  largest_component = std::max(largest_component, other.largest_component);
  persistency_ops += other.persistency_ops;
  greedy_push_ops += other.greedy_push_ops;
  boykov_kolmogorov_ops += other.boykov_kolmogorov_ops;
  push_relabel_ops += other.push_relabel_ops;
  budget_hit |= other.budget_hit;
  discarded |= other.discarded;
  energy += other.energy;
  flow += other.flow;
  return *this;
}

GridCut::GridCut(const frame::ImageShape& shape, const Config& config, memory::FixedMemory& memory)
    : config_(checked(shape, config)),
      contraction_(shape, config_.max_unknown, memory),
      queue_(
          memory.take<std::uint32_t>("min-cut: work lists", config_.max_unknown + std::size_t{1})),
      components_(config_.max_unknown, memory),
      boykov_kolmogorov_(std::min(config_.max_unknown, config_.bk_most_nodes), memory),
      push_relabel_(config_.max_unknown, memory) {}

bool GridCut::is_worth_keeping(const CutReport& report) const noexcept {
  return static_cast<float>(report.fixed_by_persistency + report.solved) >=
         config_.least_finished * static_cast<float>(report.unknown - report.coarse_by_cap);
}

CutReport GridCut::discard(const GridProblem& problem, std::span<const frame::Label> labels,
                           CutReport report) noexcept {
  for_each_row_piece(problem, [&](std::size_t first, std::size_t cells) noexcept {
    for (std::size_t cell = first; cell < first + cells; ++cell) {
      Seed& seed = problem.seeds[cell];
      // What an earlier cut decided has its label.
      const bool is_of_this_cut =
          (seed == Seed::kDecidedGround && labels[cell] == frame::Label::kObstacle) ||
          (seed == Seed::kDecidedObstacle && labels[cell] != frame::Label::kObstacle);
      if (is_of_this_cut || seed == Seed::kUnknown) seed = pinned_to(labels[cell]);
    }
  });
  report.fixed_by_persistency = report.solved = report.certified = 0;
  report.coarse_by_budget = report.unknown - report.coarse_by_cap;
  report.budget_hit = report.discarded = true;
  return report;
}

CutReport GridCut::solve_contracted(const GridProblem& problem,
                                    const Contraction::Result& contracted, OpClock& clock,
                                    std::span<frame::Label> labels) noexcept {
  assert(problem.seeds.size() >= problem.shape.cells() && labels.size() >= problem.shape.cells());
  CutReport report;
  report.unknown = contracted.unknown;
  report.coarse_by_cap = contracted.pinned;
  report.fixed_by_persistency = contracted.decided;
  report.persistency_ops = contracted.ops;
  if (!contracted.finished) {
    report.unknown = contracted.decided + contracted.pinned;
    for_each_row_piece(problem, [&](std::size_t first, std::size_t cells) noexcept {
      for_each_unknown(problem.seeds.subspan(first, cells),
                       [&](std::size_t) noexcept { ++report.unknown; });
    });
    return discard(problem, labels, report);
  }
  if (clock.expired() && !is_worth_keeping(report)) return discard(problem, labels, report);
  report.greedy_push_ops = push_one_hop(graph_);
  components_.find(graph_, contraction_.cells(), problem.ground_range_m);
  report.components = components_.count();

  std::int64_t cost_beyond_flow = 0;
  for (std::uint32_t i = 0; i < components_.count(); ++i) {
    const std::span<const std::uint32_t> component = components_[i];
    const auto cells = static_cast<std::uint32_t>(component.size());
    report.largest_component = std::max(report.largest_component, cells);
    const bool started = !clock.exhausted();
    if (started && solve_component(component, clock, report)) {
      ++report.components_solved;
      report.solved += cells;
      for (const std::uint32_t index : component) decide(index, problem.seeds);
    } else {
      report.budget_hit = true;
      if (!is_worth_keeping(report)) return discard(problem, labels, report);
      cost_beyond_flow += finalize_unfinished(component, started, labels, problem.seeds, report);
    }
  }

  for_each_row_piece(problem, [&](std::size_t first, std::size_t cells) noexcept {
    take_decisions(problem.seeds.subspan(first, cells), labels.subspan(first, cells));
    if (!report.budget_hit) return;
    for_each_unknown(problem.seeds.subspan(first, cells), [&](std::size_t i) noexcept {
      problem.seeds[first + i] = pinned_to(labels[first + i]);
    });
  });
  report.flow = graph_.flow;
  report.energy = graph_.flow + cost_beyond_flow;
  return report;
}

void GridCut::decide(std::uint32_t index, std::span<Seed> seeds) const noexcept {
  seeds[contraction_.cells()[index]] = decided(graph_.nodes[index].side);
}

bool GridCut::solve_component(std::span<const std::uint32_t> component, OpClock& clock,
                              CutReport& report) noexcept {
  if (component.size() <= config_.bk_most_nodes) {
    const std::int64_t before = clock.ops();
    const std::int64_t bk_budget =
        config_.bk_ops_base + config_.bk_ops_per_node * static_cast<std::int64_t>(component.size());
    const bool bk_finished = boykov_kolmogorov_.solve(graph_, component, clock, before + bk_budget);
    report.boykov_kolmogorov_ops += clock.ops() - before;
    if (bk_finished) return true;
    if (clock.exhausted()) return false;
  }

  const std::int64_t handed_over = clock.ops();
  ++report.push_relabel_runs;
  const bool finished = push_relabel_.solve(graph_, component, clock);
  report.push_relabel_ops += clock.ops() - handed_over;
  return finished;
}

std::int64_t GridCut::finalize_unfinished(std::span<const std::uint32_t> component, bool started,
                                          std::span<const frame::Label> labels,
                                          std::span<Seed> seeds, CutReport& report) noexcept {
  std::uint32_t certified = 0;
  if (started) {
    certified = certify(graph_, component, queue_);
  } else {
    for (const std::uint32_t index : component) graph_.nodes[index].side = Side::kFree;
  }
  for (const std::uint32_t index : component) {
    CutNode& node = graph_.nodes[index];
    if (node.side != Side::kFree) {
      decide(index, seeds);
    } else {
      const bool is_obstacle = labels[contraction_.cells()[index]] == frame::Label::kObstacle;
      node.side = is_obstacle ? Side::kObstacle : Side::kGround;
    }
  }
  report.certified += certified;
  report.coarse_by_budget += static_cast<std::uint32_t>(component.size()) - certified;
  return residual_cost(graph_, component);
}

}  // namespace terracut::min_cut
