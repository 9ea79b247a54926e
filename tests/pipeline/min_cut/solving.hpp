// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "pipeline/min_cut/grid_cut.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "test_problem.hpp"

namespace terracut::test {

inline constexpr min_cut::CutBudget kNoLimit{min_cut::CutBudget::kUnlimited};

struct Solution {
  min_cut::CutReport report;
  std::vector<frame::Label> labels;
  std::vector<std::uint32_t> coarse_cells;  ///< Unknown ones that are not decided.
};

/// Solves with a solver of its own.
inline Solution solve(const TestProblem& problem, const min_cut::GridCut::Config& config = {},
                      const min_cut::CutBudget& budget = kNoLimit) {
  memory::FixedMemory memory;
  min_cut::GridCut cut(problem.shape, config, memory);
  Solution solution;
  solution.labels = problem.coarse_labelling();
  std::vector<min_cut::Seed> seeds;
  solution.report =
      cut.solve(problem.view(seeds), problem.costs(), problem.weights(), budget, solution.labels);
  for (std::uint32_t cell = 0; cell < seeds.size(); ++cell) {
    const bool is_decided = seeds[cell] == min_cut::Seed::kDecidedGround ||
                            seeds[cell] == min_cut::Seed::kDecidedObstacle;
    if (problem.seeds[cell] == min_cut::Seed::kUnknown &&
        (solution.report.discarded || !is_decided)) {
      solution.coarse_cells.push_back(cell);
    }
  }
  return solution;
}

/// Hands out whatever a stopped cut has, were it nothing but what persistency fixed.
inline min_cut::GridCut::Config keep_all(min_cut::GridCut::Config config = {}) {
  config.least_finished = 0;
  return config;
}

inline min_cut::GridCut::Config push_relabel_only() {
  min_cut::GridCut::Config config;
  config.bk_most_nodes = 0;
  return config;
}

}  // namespace terracut::test
