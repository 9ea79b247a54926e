// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What must not change the answer, or must change it in a known way.
#include <gtest/gtest.h>

#include <algorithm>

#include "solving.hpp"

namespace terracut::test {
namespace {

TestProblem rotated(const TestProblem& problem, int columns) {
  TestProblem out(problem.shape);
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    const std::uint32_t q = problem.cell(row, (column + columns) % problem.shape.columns);
    out.seeds[q] = problem.seeds[p];
    out.cost_ground[q] = problem.cost_ground[p];
    out.cost_obstacle[q] = problem.cost_obstacle[p];
    out.ground_range_m[q] = problem.ground_range_m[p];
    out.coarse[q] = problem.coarse[p];
    out.weight[q] = problem.weight[p];
  });
  return out;
}

TEST(GridCutMetamorphic, RotatingTheSensorRotatesTheLabels) {
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    const int columns = uniform(random, 1, problem.shape.columns - 1);
    const Solution straight = solve(problem);
    const Solution other = solve(rotated(problem, columns));
    ASSERT_EQ(other.report.energy, straight.report.energy);
    problem.for_each_cell([&](int row, int column, std::uint32_t p) {
      ASSERT_EQ(other.labels[problem.cell(row, (column + columns) % problem.shape.columns)],
                straight.labels[p]);
    });
  }
}

TEST(GridCutMetamorphic, ScalingAllCapacitiesScalesTheEnergyAndKeepsTheLabels) {
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem =
        random_problem({6, 16}, {.max_weight = 500, .max_cost = 900}, random);
    TestProblem scaled = problem;
    for (auto& cost : scaled.cost_ground) cost *= 4;
    for (auto& cost : scaled.cost_obstacle) cost *= 4;
    for (auto& weights : scaled.weight) {
      for (auto& weight : weights) weight = static_cast<std::uint16_t>(weight * 4);
    }
    const Solution before = solve(problem), after = solve(scaled);
    ASSERT_EQ(after.report.energy, 4 * before.report.energy);
    ASSERT_EQ(after.labels, before.labels);
  }
}

TEST(GridCutMetamorphic, SwappingGroundAndObstacleKeepsTheEnergy) {
  Random random(13);
  const auto swapped = [](frame::Label label) {
    return label == frame::Label::kGround     ? frame::Label::kObstacle
           : label == frame::Label::kObstacle ? frame::Label::kGround
                                              : label;
  };
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    TestProblem mirror = problem;
    std::swap(mirror.cost_ground, mirror.cost_obstacle);
    for (min_cut::Seed& seed : mirror.seeds) {
      if (seed == min_cut::Seed::kGround)
        seed = min_cut::Seed::kObstacle;
      else if (seed == min_cut::Seed::kObstacle)
        seed = min_cut::Seed::kGround;
    }
    Solution solution = solve(mirror);
    ASSERT_EQ(solution.report.energy, solve(problem).report.energy);
    std::transform(solution.labels.begin(), solution.labels.end(), solution.labels.begin(),
                   swapped);
    ASSERT_EQ(problem.energy(solution.labels), solution.report.energy);
  }
}

TEST(GridCutMetamorphic, TheSolverThatFinishesDoesNotChangeTheLabels) {
  Random random(14);
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    ASSERT_EQ(solve(problem).labels, solve(problem, push_relabel_only()).labels);
  }
}

TEST(GridCutMetamorphic, AReusedSolverRemembersNothing) {
  Random random(15);
  memory::FixedMemory memory;
  const frame::ImageShape shape{7, 21};
  min_cut::GridCut cut(shape, {}, memory);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = random_problem(shape, {.holes = i % 50}, random);
    std::vector<frame::Label> labels = problem.coarse_labelling();
    const min_cut::CutBudget budget{i % 3 == 0 ? uniform(random, 0, 300)
                                               : min_cut::CutBudget::kUnlimited};
    std::vector<min_cut::Seed> seeds;
    const min_cut::CutReport report =
        cut.solve(problem.view(seeds), problem.costs(), problem.weights(), budget, labels);
    const Solution fresh = solve(problem, {}, budget);
    ASSERT_EQ(labels, fresh.labels);
    ASSERT_EQ(report.energy, fresh.report.energy);
    ASSERT_EQ(report.boykov_kolmogorov_ops, fresh.report.boykov_kolmogorov_ops);
  }
}

}  // namespace
}  // namespace terracut::test
