// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sums and signs only: how long anything takes on a shared machine is nobody's promise.
#include "rt/scheduler_times.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "rt/thread_cpu_clock.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::rt {
namespace {

void work_for_cpu_ns(std::int64_t time_ns) {
  const std::int64_t end = thread_cpu_ns() + time_ns;
  while (thread_cpu_ns() < end) {
  }
}

TEST(SchedulerTimes, CountsWorkAsProcessorTime) {
  const SchedulerTimes times = SchedulerTimes::of_this_thread();
  const SchedulerReading before = times.read();
  work_for_cpu_ns(20'000'000);
  const SchedulerReading spent = times.read().since(before);
  EXPECT_GE(spent.cpu_ns, 20'000'000);
  EXPECT_GE(spent.wall_ns, 20'000'000);
  EXPECT_GE(spent.waited_ns, 0);
}

TEST(SchedulerTimes, CountsSleepAsTimeButNotAsWork) {
  const SchedulerTimes times = SchedulerTimes::of_this_thread();
  const SchedulerReading before = times.read();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const SchedulerReading spent = times.read().since(before);
  EXPECT_GE(spent.wall_ns, 50'000'000);
  EXPECT_LT(spent.cpu_ns, spent.wall_ns);
  EXPECT_GE(spent.voluntary_switches, 1);
}

TEST(SchedulerTimes, CountsTheTurnsOfAnotherThreadOnTheSameCoreAsWaiting) {
  std::int64_t waited_ns = 0;
  std::int64_t switches = 0;
  bool known = false;
  std::atomic<bool> stop{false};
  // Both threads inherit the one core.
  std::thread([&] {
    ::cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &one);
    if (::sched_setaffinity(0, sizeof one, &one) != 0) return;
    std::thread rival([&] {
      while (!stop.load(std::memory_order_relaxed)) {
      }
    });
    const SchedulerTimes times = SchedulerTimes::of_this_thread();
    known = times.knows_waiting();
    const SchedulerReading before = times.read();
    work_for_cpu_ns(50'000'000);
    const SchedulerReading spent = times.read().since(before);
    waited_ns = spent.waited_ns;
    switches = spent.involuntary_switches;
    stop.store(true, std::memory_order_relaxed);
    rival.join();
  }).join();
  if (!known) GTEST_SKIP() << "this kernel does not tell how long threads wait";
  EXPECT_GT(waited_ns, 1'000'000);
  EXPECT_GT(switches, 0);
}

TEST(SchedulerTimes, AllocatesNothingWhenRead) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "the sanitizer brings its own allocator";
  const SchedulerTimes times = SchedulerTimes::of_this_thread();
  const std::uint64_t before = test::allocations_of_this_thread();
  std::int64_t last_ns = 0;
  for (int n = 0; n < 10; ++n) last_ns = times.read().wall_ns;
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_GT(last_ns, 0);
}

}  // namespace
}  // namespace terracut::rt
