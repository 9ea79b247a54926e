// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// solve() takes no memory: this program counts every operator new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/pipeline/min_cut/solving.hpp"

namespace {
thread_local bool counting = false;
thread_local int allocations = 0;

void* counted(std::size_t bytes, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  void* block = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
}  // namespace

void* operator new(std::size_t bytes) { return counted(bytes, alignof(std::max_align_t)); }
void* operator new[](std::size_t bytes) { return counted(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, std::align_val_t a) { return counted(bytes, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t bytes, std::align_val_t a) { return counted(bytes, static_cast<std::size_t>(a)); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

namespace terracut::pipeline::test {
namespace {

TEST(GridCutMemory, SolvingAllocatesNothing) {
  Random random(31);
  const ImageShape shape{32, 128};
  const TestProblem problem = random_problem(shape, {.ground_seeds = 5, .obstacle_seeds = 5}, random);
  GridCut::Config config = push_relabel_only();
  config.max_unknown = 2000;  // the cap, both solvers and the certificate all have their turn
  rt::FixedMemory memory;
  GridCut cut(shape, config, memory);
  const std::size_t bytes_planned = memory.total_bytes();
  std::vector<Label> labels = problem.coarse_labelling();
  std::vector<Label> again = labels;

  allocations = 0;
  counting = true;
  const CutReport whole = cut.solve(problem.view(), problem.weights(), kNoLimit, labels);
  const CutReport stopped = cut.solve(problem.view(), problem.weights(), {3000}, again);
  counting = false;

  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(memory.total_bytes(), bytes_planned);
  EXPECT_GT(whole.coarse_by_cap, 0U);
  EXPECT_GT(whole.push_relabel_runs, 0U);
  EXPECT_TRUE(stopped.budget_hit);
}

TEST(GridCutMemory, TheCountingWorks) {
  counting = true;
  allocations = 0;
  auto* block = ::operator new(16);
  counting = false;
  ::operator delete(block);
  EXPECT_EQ(allocations, 1);
}

}  // namespace
}  // namespace terracut::pipeline::test
