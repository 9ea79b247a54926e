// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/thread_cpu_clock.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace terracut::measure {
namespace {

TEST(ThreadCpuClock, IsReadAsATimeSinceAnEarlierReading) {
  const ClockPair spent = ClockPair{70, 900}.since({30, 200});
  EXPECT_EQ(spent.cpu_ns, 40);
  EXPECT_EQ(spent.wall_ns, 700);
}

TEST(ThreadCpuClock, StandsWhileTheThreadSleeps) {
  const ClockPair start = ClockPair::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const ClockPair slept = ClockPair::now().since(start);
  EXPECT_GE(slept.wall_ns, 30'000'000);
  EXPECT_LT(slept.cpu_ns, slept.wall_ns);
}

TEST(ThreadCpuClock, RunsWhileTheThreadWorks) {
  const std::int64_t start_ns = thread_cpu_ns();
  volatile double sum = 0;
  for (int i = 0; i < 1'000'000; ++i) sum = sum + i;
  EXPECT_GT(thread_cpu_ns(), start_ns);
}

TEST(ThreadCpuClock, DoesNotCountOtherThreads) {
  const ClockPair start = ClockPair::now();
  std::int64_t worked_ns = 0;
  std::thread worker([&] {
    const std::int64_t start_ns = thread_cpu_ns();
    while (thread_cpu_ns() - start_ns < 30'000'000) {
    }
    worked_ns = thread_cpu_ns() - start_ns;
  });
  worker.join();
  EXPECT_LT(ClockPair::now().since(start).cpu_ns, worked_ns);
}

}  // namespace
}  // namespace terracut::measure
