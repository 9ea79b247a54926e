// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sums and signs only: how long anything takes on a shared machine is nobody's promise.
#include "rt/measure/run_queue_wait.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <thread>

#include "rt/measure/thread_cpu_clock.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::measure {
namespace {

void work_for_cpu_ns(std::int64_t time_ns) {
  const std::int64_t end = thread_cpu_ns() + time_ns;
  while (thread_cpu_ns() < end) {
  }
}

TEST(RunQueueWait, CountsTheFramesOfAnotherThreadOnTheSameCore) {
  std::int64_t waited_ns = 0;
  bool known = false;
  std::atomic<bool> stop{false};
  // Both threads inherit the one core.
  std::thread([&] {
    ::cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &one);
    if (::sched_setaffinity(0, sizeof one, &one) != 0) return;
    std::thread baseline([&] {
      while (!stop.load(std::memory_order_relaxed)) {
      }
    });
    const RunQueueWait wait = RunQueueWait::of_this_thread();
    known = wait.is_known();
    const std::int64_t before_ns = wait.read_ns();
    work_for_cpu_ns(50'000'000);
    waited_ns = wait.read_ns() - before_ns;
    stop.store(true, std::memory_order_relaxed);
    baseline.join();
  }).join();
  if (!known) GTEST_SKIP() << "this kernel does not tell how long threads wait";
  EXPECT_GT(waited_ns, 1'000'000);
}

TEST(RunQueueWait, CountsNeitherWorkNorSleep) {
  const RunQueueWait wait = RunQueueWait::of_this_thread();
  const std::int64_t waited_before_ns = wait.read_ns();
  const ClockPair begun = ClockPair::now();
  work_for_cpu_ns(20'000'000);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::int64_t waited_ns = wait.read_ns() - waited_before_ns;
  const ClockPair spent = ClockPair::now().since(begun);
  EXPECT_GE(waited_ns, 0);
  // The two took 70 ms; half of it, because the kernel's clocks are not one.
  EXPECT_LE(waited_ns, spent.wall_ns - 35'000'000);
}

TEST(RunQueueWait, IsTheSecondOfTheNumbersTheKernelTells) {
  const RunQueueWait wait = RunQueueWait::of_this_thread();
  if (!wait.is_known()) GTEST_SKIP() << "this kernel does not tell how long threads wait";
  const auto told_ns = [] {
    std::int64_t ran_ns = -1, waited_ns = -1;
    std::ifstream("/proc/thread-self/schedstat") >> ran_ns >> waited_ns;
    return waited_ns;
  };
  work_for_cpu_ns(5'000'000);
  const std::int64_t before_ns = told_ns();
  const std::int64_t waited_ns = wait.read_ns();
  EXPECT_GE(waited_ns, before_ns);
  EXPECT_LE(waited_ns, told_ns());
}

TEST(RunQueueWait, AllocatesNothingWhenRead) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "the sanitizer brings its own allocator";
  const RunQueueWait wait = RunQueueWait::of_this_thread();
  const std::uint64_t before = test::allocations_of_this_thread();
  std::int64_t last_ns = -1;
  for (int n = 0; n < 10; ++n) last_ns = wait.read_ns();
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_GE(last_ns, 0);
}

}  // namespace
}  // namespace terracut::measure
