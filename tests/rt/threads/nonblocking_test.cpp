// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Everything of this room that real-time threads call, called from one function that is marked
// itself: Clang 22 and later then refuse whatever could block while compiling
// (-Wfunction-effects), 20 and later stop it while running (-fsanitize=realtime). Other compilers
// check that nothing is allocated.
#include "rt/threads/nonblocking.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "pipeline/page/status_page.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "rt/measure/page_faults.hpp"
#include "rt/measure/run_queue_wait.hpp"
#include "rt/measure/stolen_time.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/queues/spsc_queue.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::threads {
namespace {

struct Health {
  std::int64_t frames = 0;
  std::int64_t wall_ns = 0;
};

/// What a working thread has beside its frames.
struct Tools {
  memory::FixedMemory memory;
  queues::SpscQueue<std::uint32_t> queue{"queue", 4, memory};
  queues::LatestValue<std::int64_t> latest;
  measure::LogLinearHistogram histogram;
  measure::RunQueueWait wait = measure::RunQueueWait::of_this_thread();
  std::optional<measure::StolenTime> stolen;
  std::optional<page::StatusPagePublisher<Health>> page;
  std::optional<page::StatusPageReader<Health>> reader;
};

/// Returns how many of its steps went wrong.
int one_frame(Tools& tools, std::int64_t number) noexcept TERRACUT_NONBLOCKING {
  int wrong = 0;
  const measure::PageFaults faults = measure::PageFaults::of_this_thread();
  const std::int64_t waited_before_ns = tools.wait.read_ns();
  std::int64_t stolen_ns = 0;
  if (tools.stolen) stolen_ns = tools.stolen->read_ns().value_or(0);
  const measure::ClockPair start = measure::ClockPair::now();

  std::uint32_t slot = 0;
  if (!tools.queue.try_push(7)) ++wrong;
  if (tools.queue.size_approx() != 1) ++wrong;
  if (!tools.queue.try_pop(slot) || slot != 7) ++wrong;
  tools.latest.publish(number);
  const std::int64_t* newest = tools.latest.take_if_new();
  if (newest == nullptr || *newest != number) ++wrong;

  const measure::ClockPair spent = measure::ClockPair::now().since(start);
  tools.histogram.record(spent.wall_ns);
  const std::int64_t waited_ns = tools.wait.read_ns() - waited_before_ns;
  if (tools.stolen) stolen_ns = tools.stolen->read_ns().value_or(0) - stolen_ns;
  if (waited_ns < 0 || stolen_ns < 0) ++wrong;
  if (measure::PageFaults::of_this_thread().since(faults).minor < 0) ++wrong;
  if (tools.page) {
    tools.page->publish({number, spent.wall_ns});
    const auto health = tools.reader->read();
    if (!health || health->frames != number) ++wrong;
  }
  return wrong;
}

TEST(NonBlocking, HoldsForEverythingThatRealTimeThreadsCall) {
  Tools tools;
  if (auto stolen = measure::StolenTime::open()) tools.stolen.emplace(std::move(*stolen));
  if (std::filesystem::is_directory("/dev/shm")) {
    const std::string name = "terracut-test-" + std::to_string(::getpid());
    auto page = page::StatusPagePublisher<Health>::create(name, 1, "/dev/shm");
    ASSERT_TRUE(page.has_value()) << page.error().message;
    tools.page.emplace(std::move(*page));
    auto reader = page::StatusPageReader<Health>::open(name, 1, "/dev/shm");
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    tools.reader.emplace(std::move(*reader));
  }
  const std::uint64_t before = test::allocations_of_this_thread();
  int wrong = 0;
  for (std::int64_t number = 1; number <= 100; ++number) wrong += one_frame(tools, number);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(tools.histogram.count(), 100U);
}

}  // namespace
}  // namespace terracut::threads
