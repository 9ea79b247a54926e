// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Families of problems that are hard for one solver or another, at the size of the default cap.
#include <gtest/gtest.h>

#include "adversarial_problems.hpp"
#include "boost_oracle.hpp"
#include "solving.hpp"

namespace terracut::test {
namespace {

class GridCutAdversarial : public testing::TestWithParam<AdversarialFamily> {};

std::string name_of(const testing::TestParamInfo<AdversarialFamily>& info) {
  return std::string(info.param.name);
}

std::int64_t solver_ops(const min_cut::CutReport& report) {
  return report.boykov_kolmogorov_ops + report.push_relabel_ops;
}

TEST_P(GridCutAdversarial, IsExactAtSixteenThousandCells) {
  const TestProblem problem = GetParam().make({64, 256});
  const Solution solution = solve(problem);
  ASSERT_TRUE(solution.report.exact());
  EXPECT_EQ(problem.energy(solution.labels), solution.report.energy);
  EXPECT_EQ(solution.report.energy, boost_optimum(problem).energy);
}

TEST_P(GridCutAdversarial, StaysBelowItsCeilingOfOperations) {
  const Solution solution = solve(GetParam().make({64, 256}));
  EXPECT_LT(solver_ops(solution.report), 7'000'000) << "a change made the worst case worse";
}

TEST_P(GridCutAdversarial, PushRelabelAloneIsExactToo) {
  const TestProblem problem = GetParam().make({32, 96});
  const Solution solution = solve(problem, push_relabel_only());
  ASSERT_TRUE(solution.report.exact());
  EXPECT_GT(solution.report.push_relabel_runs, 0U);
  EXPECT_EQ(solution.report.energy, boost_optimum(problem).energy);
}

TEST_P(GridCutAdversarial, TheDefaultBudgetIsKept) {
  const TestProblem problem = GetParam().make({64, 256});
  const Solution solution = solve(problem, {}, min_cut::CutBudget{});
  EXPECT_LT(solver_ops(solution.report), min_cut::CutBudget::kDefaultOps * 11 / 10);
  EXPECT_LE(problem.energy(solution.labels), problem.energy(problem.coarse_labelling()));
  if (solution.report.discarded) {
    EXPECT_EQ(solution.labels, problem.coarse_labelling());
  } else {
    EXPECT_EQ(problem.energy(solution.labels), solution.report.energy);
  }
}

TEST_P(GridCutAdversarial, StoppedAnywhereItIsNotAboveTheEnergyOfTheCoarseLabels) {
  const TestProblem problem = GetParam().make({32, 96});
  const std::int64_t coarse_energy = problem.energy(problem.coarse_labelling());
  for (std::int64_t ops = 0; ops < 3'000'000; ops = 3 * ops + 500) {
    SCOPED_TRACE(ops);
    const Solution solution = solve(problem, keep_all(), {ops});
    ASSERT_EQ(problem.energy(solution.labels), solution.report.energy);
    ASSERT_LE(solution.report.energy, coarse_energy);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, GridCutAdversarial,
                         testing::ValuesIn(adversarial_families().begin(),
                                           adversarial_families().end()),
                         name_of);

TEST(GridCutTypical, StaysBelowItsCeilingOfOperations) {
  const TestProblem problem = typical_problem({64, 2083}, 1);
  const Solution solution = solve(problem, {}, min_cut::CutBudget{});
  ASSERT_TRUE(solution.report.exact());
  EXPECT_LT(solver_ops(solution.report), 80'000);
}

TEST(GridCutTypical, EqualsAnIndependentSolver) {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const TestProblem problem = typical_problem({64, 2083}, seed);
    const Solution solution = solve(problem);
    const Optimum optimum = boost_optimum(problem);
    EXPECT_EQ(solution.report.energy, optimum.energy);
    EXPECT_EQ(solution.labels, optimum.labels);
  }
}

}  // namespace
}  // namespace terracut::test
