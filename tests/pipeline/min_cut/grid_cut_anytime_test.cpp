// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What is answered when there is more to do than time: caps, budgets, clocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "boost_oracle.hpp"
#include "solving.hpp"

namespace terracut::test {
namespace {

constexpr RandomRecipe kManyHoles{.holes = 45, .ground_seeds = 5, .obstacle_seeds = 5};

std::uint32_t exact_cells(const min_cut::CutReport& report) {
  return report.fixed_by_persistency + report.solved;
}

void expect_consistent(const TestProblem& problem, const Solution& solution) {
  const min_cut::CutReport& r = solution.report;
  ASSERT_EQ(r.unknown, problem.unknown());
  ASSERT_EQ(r.unknown,
            r.fixed_by_persistency + r.solved + r.certified + r.coarse_by_cap + r.coarse_by_budget);
  ASSERT_EQ(solution.coarse_cells.size(), r.coarse_by_cap + r.coarse_by_budget);
  for (const std::uint32_t cell : solution.coarse_cells) {
    ASSERT_EQ(problem.seeds[cell], min_cut::Seed::kUnknown);
    ASSERT_EQ(solution.labels[cell], problem.coarse[cell]);
  }
}

TEST(GridCutAnytime, AnyBudgetGivesAnEnergyBetweenOptimumAndCoarse) {
  Random random(21);
  int stopped = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    const min_cut::GridCut::Config config =
        keep_all(i % 2 == 0 ? min_cut::GridCut::Config{} : push_relabel_only());
    const Solution best = solve(problem, config);
    const Solution solution = solve(problem, config, {uniform(random, 0, 1500)});
    ASSERT_NO_FATAL_FAILURE(expect_consistent(problem, solution));
    ASSERT_EQ(problem.energy(solution.labels), solution.report.energy);
    ASSERT_LE(solution.report.flow, best.report.energy);
    ASSERT_GE(solution.report.energy, best.report.energy);
    ASSERT_LE(solution.report.energy, problem.energy(problem.coarse_labelling()));
    stopped += solution.report.budget_hit ? 1 : 0;
  }
  EXPECT_GT(stopped, 200);
}

TEST(GridCutAnytime, EveryCellNotCoarseIsPartOfOneOptimum) {
  Random random(22);
  std::uint32_t certified = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    TestProblem problem = any_problem(random);
    const min_cut::GridCut::Config config =
        keep_all(i % 2 == 0 ? min_cut::GridCut::Config{} : push_relabel_only());
    const Solution solution = solve(problem, config, {uniform(random, 0, 1500)});
    certified += solution.report.certified;
    const std::int64_t optimum = boost_optimum(problem).energy;
    // With the answered cells forced to their label, the rest can still be chosen optimally.
    const std::set<std::uint32_t> coarse(solution.coarse_cells.begin(),
                                         solution.coarse_cells.end());
    problem.for_each_cell([&](int, int, std::uint32_t p) {
      if (problem.seeds[p] != min_cut::Seed::kUnknown || coarse.contains(p)) return;
      (solution.labels[p] == frame::Label::kObstacle ? problem.cost_ground
                                                     : problem.cost_obstacle)[p] = 1 << 24;
    });
    ASSERT_EQ(boost_optimum(problem).energy, optimum);
  }
  EXPECT_GT(certified, 1000U);
}

TEST(GridCutAnytime, MoreOperationsNeverSolveFewerCells) {
  Random random(23);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = random_problem({10, 40}, kManyHoles, random);
    std::uint32_t exact = 0;
    for (std::int64_t ops = 0; ops < 6000; ops = ops + 1 + ops / 4) {
      const Solution solution = solve(problem, keep_all(), {ops});
      ASSERT_GE(exact_cells(solution.report), exact) << ops;
      exact = exact_cells(solution.report);
    }
    ASSERT_GT(exact, 0U);
  }
}

TEST(GridCutAnytime, NoOperationsStillGiveWhatPersistencyFixes) {
  Random random(24);
  const TestProblem problem = random_problem({10, 40}, kManyHoles, random);
  const Solution solution = solve(problem, keep_all(), {0});
  EXPECT_TRUE(solution.report.budget_hit);
  EXPECT_GT(solution.report.fixed_by_persistency, 0U);
  EXPECT_EQ(solution.report.solved + solution.report.certified, 0U);
  EXPECT_EQ(solution.report.boykov_kolmogorov_ops, 0);
  expect_consistent(problem, solution);
}

TEST(GridCutAnytime, TheNearestComponentIsSolvedFirst) {
  // Two rows of undecided cells, far apart; the farther one comes first in the image.
  TestProblem problem({5, 32});
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    if (row != 0 && row != 4) return;
    problem.seeds[p] = min_cut::Seed::kUnknown;
    problem.ground_range_m[p] = row == 0 ? 50.0F : 5.0F;
    problem.cost_ground[p] = column % 4 == 0 ? 100 : 0;
    problem.cost_obstacle[p] = column % 4 == 2 ? 101 : 0;
    problem.set_weight(row, column, 4, 1000);
  });
  std::int64_t ops = 0;
  Solution solution;
  do solution = solve(problem, {}, {ops++});
  while (solution.report.components_solved == 0);
  ASSERT_EQ(solution.report.components, 2U);
  ASSERT_EQ(solution.report.components_solved, 1U);
  ASSERT_FALSE(solution.coarse_cells.empty());
  for (const std::uint32_t cell : solution.coarse_cells)
    EXPECT_EQ(problem.ground_range_m[cell], 50.0F);
}

TEST(GridCutAnytime, WhereAllNodesAreInUseCellsOfHigherRowsStayCoarse) {
  Random random(25);
  std::uint32_t capped = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    min_cut::GridCut::Config config;
    config.max_unknown = static_cast<std::uint32_t>(uniform(random, 0, 50));
    const Solution solution = solve(problem, config);
    ASSERT_NO_FATAL_FAILURE(expect_consistent(problem, solution));
    ASSERT_EQ(solution.report.coarse_by_budget, 0U);
    ASSERT_LE(solution.report.solved, config.max_unknown);
    ASSERT_EQ(solution.report.coarse_by_cap, solution.coarse_cells.size());
    capped += solution.report.coarse_by_cap > 0 ? 1 : 0;

    TestProblem pinned = problem;
    for (const std::uint32_t cell : solution.coarse_cells) {
      pinned.seeds[cell] = problem.coarse[cell] == frame::Label::kObstacle
                               ? min_cut::Seed::kObstacle
                               : min_cut::Seed::kGround;
    }
    const Optimum optimum = boost_optimum(pinned);  // the rest is the optimum around them
    ASSERT_EQ(solution.report.energy, optimum.energy);
    ASSERT_EQ(solution.labels, optimum.labels);

    if (solution.coarse_cells.empty()) continue;
    const auto first_coarse = problem.seeds.begin() + solution.coarse_cells.front();
    ASSERT_GE(std::count(problem.seeds.begin(), first_coarse, min_cut::Seed::kUnknown),
              config.max_unknown)
        << "no node is left unused";
  }
  EXPECT_GT(capped, 50U);
}

TEST(GridCutAnytime, RangesThatAreNoneChangeNoLabel) {
  Random random(26);
  TestProblem problem = random_problem({8, 40}, {}, random);
  const Solution usual = solve(problem);
  const float odd[] = {std::numeric_limits<float>::quiet_NaN(), -3.0F,
                       std::numeric_limits<float>::infinity(), 1e30F};
  for (std::size_t p = 0; p < problem.ground_range_m.size(); ++p)
    problem.ground_range_m[p] = odd[p % 4];
  EXPECT_EQ(solve(problem).labels, usual.labels);
}

TEST(GridCutAnytime, WithTooLittleFinishedAllStaysCoarse) {
  Random random(30);
  int kept = 0, discarded = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    min_cut::GridCut::Config config;
    if (i % 3 == 0) config.max_unknown = 100;
    const min_cut::CutBudget budget{uniform(random, 0, 1500)};
    const Solution whatever = solve(problem, keep_all(config), budget);
    const Solution solution = solve(problem, config, budget);
    ASSERT_NO_FATAL_FAILURE(expect_consistent(problem, solution));
    if (!whatever.report.budget_hit) continue;
    const std::uint32_t solved_for = whatever.report.unknown - whatever.report.coarse_by_cap;
    ASSERT_EQ(solution.report.discarded, 2 * exact_cells(whatever.report) < solved_for);
    ASSERT_FALSE(whatever.report.discarded);
    if (solution.report.discarded) {
      ++discarded;
      ASSERT_TRUE(solution.report.budget_hit);
      ASSERT_EQ(solution.labels, problem.coarse_labelling());
      ASSERT_EQ(solution.coarse_cells.size(), problem.unknown());
    } else {
      ++kept;
      ASSERT_EQ(solution.labels, whatever.labels);
    }
  }
  EXPECT_GT(discarded, 100);
  EXPECT_GT(kept, 50);
}

TEST(GridCutAnytime, AShareThatIsNoneIsRefused) {
  for (const float share : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN()}) {
    memory::FixedMemory memory;
    EXPECT_THROW(min_cut::GridCut({4, 8}, {.least_finished = share}, memory),
                 std::invalid_argument);
  }
}

struct FakeClock {
  int looks_left;
  static bool expired(void* context) noexcept {
    return --static_cast<FakeClock*>(context)->looks_left < 0;
  }
};

TEST(GridCutAnytime, TheClockStopsItAnywhereAndNeverAboveTheEnergyOfTheCoarseLabels) {
  Random random(27);
  const TestProblem problem =
      random_problem({32, 256}, {.holes = 5, .ground_seeds = 0, .obstacle_seeds = 0}, random);
  const std::int64_t coarse_energy = problem.energy(problem.coarse_labelling());
  const auto ops = [](const min_cut::CutReport& r) {
    return r.boykov_kolmogorov_ops + r.push_relabel_ops;
  };
  const auto most_arcs = static_cast<std::int64_t>(problem.shape.cells()) * min_cut::kDirections;
  // From the first look, at the weights, to the last one, in the solvers.
  int before_solvers = 0, in_solvers = 0;
  std::int64_t last_ops = 0;
  Solution solution;
  for (int looks = 0; looks == 0 || solution.report.budget_hit; ++looks) {
    SCOPED_TRACE(looks);
    ASSERT_LT(looks, 10'000);
    FakeClock clock{looks};
    solution =
        solve(problem, keep_all(), {min_cut::CutBudget::kUnlimited, &FakeClock::expired, &clock});
    ASSERT_NO_FATAL_FAILURE(expect_consistent(problem, solution));
    ASSERT_LE(problem.energy(solution.labels), coarse_energy);
    ASSERT_EQ(clock.looks_left < 0, solution.report.budget_hit)
        << "it is asked no more once it expired";
    ASSERT_GE(clock.looks_left, -1);
    if (solution.report.discarded) {
      ++before_solvers;
      ASSERT_EQ(solution.labels, problem.coarse_labelling());
      ASSERT_EQ(ops(solution.report), 0);
    } else {
      ++in_solvers;
      ASSERT_EQ(problem.energy(solution.labels), solution.report.energy);
      ASSERT_LE(ops(solution.report),
                last_ops + 2 * min_cut::CutBudget::kOpsPerClockLook + most_arcs)
          << "distances are measured in one go";
      last_ops = ops(solution.report);
    }
  }
  EXPECT_TRUE(solution.report.exact());
  EXPECT_GT(before_solvers, 6) << "stopped in the weights";
  EXPECT_GT(in_solvers, 2);
}

TEST(GridCutAnytime, AClockThatNeverExpiresChangesNothing) {
  Random random(28);
  const TestProblem problem =
      random_problem({32, 128}, {.ground_seeds = 2, .obstacle_seeds = 2}, random);
  FakeClock clock{1'000'000};
  const Solution with =
      solve(problem, {}, {min_cut::CutBudget::kUnlimited, &FakeClock::expired, &clock});
  const Solution without = solve(problem);
  EXPECT_EQ(with.labels, without.labels);
  EXPECT_EQ(with.report.boykov_kolmogorov_ops, without.report.boykov_kolmogorov_ops);
}

TEST(GridCutAnytime, TheSameBudgetGivesTheSameLabels) {
  Random random(29);
  for (int i = 0; i < 100; ++i) {
    const TestProblem problem = any_problem(random);
    const min_cut::CutBudget budget{uniform(random, 0, 800)};
    const Solution first = solve(problem, {}, budget), second = solve(problem, {}, budget);
    ASSERT_EQ(first.labels, second.labels);
    ASSERT_EQ(first.coarse_cells, second.coarse_cells);
  }
}

}  // namespace
}  // namespace terracut::test
