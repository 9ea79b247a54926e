// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include "solving.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::test {
namespace {

using terracut::test::allocations_of_this_thread;

TEST(GridCutMemory, SolvingAllocatesNothing) {
  if (!terracut::test::allocations_are_counted())
    GTEST_SKIP() << "sanitizers bring their own allocator";
  Random random(31);
  const frame::ImageShape shape{32, 128};
  const TestProblem problem =
      random_problem(shape, {.ground_seeds = 5, .obstacle_seeds = 5}, random);
  min_cut::GridCut::Config config = push_relabel_only();
  config.max_unknown = 2000;  // the cap, both solvers and the certificate all have their frame
  config.least_finished = 0;
  memory::FixedMemory memory;
  min_cut::GridCut cut(shape, config, memory);
  const std::size_t bytes_planned = memory.total_bytes();
  std::vector<frame::Label> labels = problem.coarse_labelling();
  std::vector<frame::Label> again = labels;
  std::vector<min_cut::Seed> seeds, same_seeds;
  const min_cut::GridProblem view = problem.view(seeds), same_view = problem.view(same_seeds);

  const std::uint64_t before = allocations_of_this_thread();
  const min_cut::CutReport whole =
      cut.solve(view, problem.costs(), problem.weights(), kNoLimit, labels);
  const min_cut::CutReport stopped =
      cut.solve(same_view, problem.costs(), problem.weights(), {3000}, again);
  const std::uint64_t after = allocations_of_this_thread();

  EXPECT_EQ(after, before);
  EXPECT_EQ(memory.total_bytes(), bytes_planned);
  EXPECT_GT(whole.coarse_by_cap, 0U);
  EXPECT_GT(whole.push_relabel_runs, 0U);
  EXPECT_TRUE(stopped.budget_hit);
}

TEST(GridCutMemory, IsPlannedByTheCapNotByTheWorstFrame) {
  const auto bytes = [](std::uint32_t max_unknown) {
    memory::FixedMemory memory;
    min_cut::GridCut cut({64, 2083}, {.max_unknown = max_unknown}, memory);
    return memory.total_bytes();
  };
  const std::size_t extra = bytes(16'384) - bytes(8'192);
  EXPECT_GE(extra, 8'192 * sizeof(min_cut::CutNode));
  EXPECT_LT(extra, 8'192 * (sizeof(min_cut::CutNode) + 80)) << "lists cost more than the nodes";
  EXPECT_EQ(bytes(64 * 2096), bytes(1'000'000)) << "more nodes than cells are never needed";
}

}  // namespace
}  // namespace terracut::test
