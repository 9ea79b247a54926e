// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The labels are a minimum cut: against an independent solver and against trying everything.
#include <gtest/gtest.h>

#include "boost_oracle.hpp"
#include "solving.hpp"

namespace terracut::test {
namespace {

void expect_optimum(const TestProblem& problem, const Solution& solution, const Optimum& optimum) {
  ASSERT_TRUE(solution.report.exact());
  ASSERT_EQ(solution.report.energy, optimum.energy);
  ASSERT_EQ(solution.report.flow, optimum.energy);
  ASSERT_EQ(problem.energy(solution.labels), optimum.energy);
  ASSERT_EQ(solution.labels, optimum.labels);
  ASSERT_EQ(solution.report.unknown, problem.unknown());
  ASSERT_EQ(solution.report.unknown, solution.report.fixed_by_persistency + solution.report.solved);
}

TEST(GridCut, EqualsAnIndependentSolverOnRandomGrids) {
  Random random(1);
  for (int i = 0; i < 10'000; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    ASSERT_NO_FATAL_FAILURE(expect_optimum(problem, solve(problem), boost_optimum(problem)));
  }
}

TEST(GridCut, EqualsAnIndependentSolverWhenPushRelabelFinishesWhatBoykovKolmogorovBegan) {
  Random random(2);
  std::uint32_t runs = 0;
  for (int i = 0; i < 10'000; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    min_cut::GridCut::Config config;
    config.bk_most_nodes = 1'000'000;
    config.bk_ops_per_node = 0;
    config.bk_ops_base = uniform(random, 1, 200);
    const Solution solution = solve(problem, config);
    ASSERT_NO_FATAL_FAILURE(expect_optimum(problem, solution, boost_optimum(problem)));
    runs += solution.report.push_relabel_runs;
  }
  EXPECT_GT(runs, 1000U);
}

TEST(GridCut, EqualsTheBestOfAllLabellingsOnTinyGrids) {
  Random random(3);
  int tried = 0;
  while (tried < 300) {
    const TestProblem problem = random_problem({uniform(random, 1, 4), uniform(random, 3, 5)},
                                               {.max_weight = 8, .max_cost = 12}, random);
    if (problem.unknown() > 12) continue;
    SCOPED_TRACE(tried++);
    const Optimum optimum = exhaustive_optimum(problem);
    ASSERT_NO_FATAL_FAILURE(expect_optimum(problem, solve(problem), optimum));
    ASSERT_NO_FATAL_FAILURE(expect_optimum(problem, solve(problem, push_relabel_only()), optimum));
  }
}

TEST(GridCut, HoldsTheLargestCapacities) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    TestProblem problem =
        random_problem({10, 24}, {.holes = 0, .zero_edges = 0, .zero_costs = 60}, random);
    problem.for_each_cell([&](int row, int column, std::uint32_t p) {
      for (int d = 4; d < min_cut::kDirections; ++d)
        problem.set_weight(row, column, d, min_cut::kMaxEdgeWeight);
      if (uniform(random, 0, 9) == 0) problem.cost_ground[p] = min_cut::kMaxTerminalCost;
      if (uniform(random, 0, 9) == 0) problem.cost_obstacle[p] = min_cut::kMaxTerminalCost;
    });
    const Optimum optimum = boost_optimum(problem);
    ASSERT_NO_FATAL_FAILURE(expect_optimum(problem, solve(problem), optimum));
    ASSERT_NO_FATAL_FAILURE(expect_optimum(problem, solve(problem, push_relabel_only()), optimum));
  }
}

TEST(GridCut, TakesLargerWeightsAndCostsAsTheLargestAllowed) {
  Random random(5);
  TestProblem limits = random_problem({6, 12}, {.max_weight = min_cut::kMaxEdgeWeight}, random);
  TestProblem beyond = limits;
  limits.for_each_cell([&](int row, int column, std::uint32_t p) {
    if (p % 3 == 0) {
      limits.set_weight(row, column, 4, min_cut::kMaxEdgeWeight);
      beyond.set_weight(row, column, 4, 65535);
    }
    if (p % 5 == 0) {
      limits.cost_ground[p] = min_cut::kMaxTerminalCost;
      beyond.cost_ground[p] = std::numeric_limits<std::int32_t>::max();
      limits.cost_obstacle[p] = 0;
      beyond.cost_obstacle[p] = -7;
    }
  });
  EXPECT_EQ(solve(beyond).labels, solve(limits).labels);
  EXPECT_EQ(solve(beyond).report.energy, solve(limits).report.energy);
}

TEST(GridCut, PrefersObstacleWhereBothLabelsCostTheSame) {
  TestProblem problem({1, 3});
  problem.seeds[0] = min_cut::Seed::kUnknown;
  EXPECT_EQ(solve(problem).labels[0], frame::Label::kObstacle);
}

TEST(GridCut, LeavesHolesAndSeedsAlone) {
  Random random(6);
  const TestProblem problem = random_problem({8, 20}, {}, random);
  const Solution solution = solve(problem);
  const std::vector<frame::Label> before = problem.coarse_labelling();
  for (std::size_t p = 0; p < before.size(); ++p) {
    if (problem.seeds[p] == min_cut::Seed::kUnknown) continue;
    EXPECT_EQ(solution.labels[p], before[p]) << p;
  }
}

TEST(GridCut, ReadsNoPaddingCell) {
  Random random(7);
  TestProblem problem = random_problem({8, 20}, {}, random);
  const Solution clean = solve(problem);
  for (int row = 0; row < problem.shape.rows; ++row) {
    for (int column = problem.shape.columns; column < problem.shape.stride(); ++column) {
      problem.seeds[static_cast<std::size_t>(row * problem.shape.stride() + column)] =
          min_cut::Seed::kUnknown;
    }
  }
  const Solution dirty = solve(problem);
  EXPECT_EQ(dirty.report.energy, clean.report.energy);
  EXPECT_EQ(dirty.report.unknown, clean.report.unknown);
}

TEST(GridCut, HasNothingToDoWithoutUnknownCells) {
  const TestProblem problem({4, 8});
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.report.unknown, 0U);
  EXPECT_EQ(solution.report.energy, 0);
  EXPECT_TRUE(solution.report.exact());
}

TEST(GridCut, RefusesAnImageTooNarrowToBeCyclic) {
  memory::FixedMemory memory;
  EXPECT_THROW(min_cut::GridCut({4, 2}, {}, memory), std::invalid_argument);
  EXPECT_THROW(min_cut::GridCut({0, 8}, {}, memory), std::invalid_argument);
}

TEST(GridCut, RefusesOperationBudgetsItCannotAddUp) {
  memory::FixedMemory memory;
  EXPECT_THROW(min_cut::GridCut({4, 8}, {.bk_ops_per_node = -1}, memory), std::invalid_argument);
  EXPECT_THROW(min_cut::GridCut({4, 8}, {.bk_ops_base = min_cut::CutBudget::kUnlimited}, memory),
               std::invalid_argument);
}

}  // namespace
}  // namespace terracut::test
