// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What it costs to hand a slot number from one thread to another: SpscQueue and LatestSlot beside
// boost::lockfree::spsc_queue. Reports, asserts nothing. The two-thread figures mean something only
// where both threads have a core to themselves.
#include <benchmark/benchmark.h>

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <thread>

#include "rt/queues/latest_value.hpp"
#include "rt/queues/spsc_queue.hpp"

namespace terracut {
namespace {

constexpr std::size_t kCapacity = 1024;

/// One interface over the three.
class OurQueue {
 public:
  bool push(std::uint32_t value) { return queue_.try_push(value); }
  bool pop(std::uint32_t& value) { return queue_.try_pop(value); }

 private:
  memory::FixedMemory memory_;
  queues::SpscQueue<std::uint32_t> queue_{"queue", kCapacity, memory_};
};

class BoostQueue {
 public:
  bool push(std::uint32_t value) { return queue_.push(value); }
  bool pop(std::uint32_t& value) { return queue_.pop(value); }

 private:
  boost::lockfree::spsc_queue<std::uint32_t, boost::lockfree::capacity<kCapacity>> queue_;
};

class OurLatestValue {
 public:
  bool push(std::uint32_t value) {
    value_.publish(value);
    return true;
  }
  bool pop(std::uint32_t& value) {
    const std::uint32_t* taken = value_.take_if_new();
    if (taken != nullptr) value = *taken;
    return taken != nullptr;
  }

 private:
  queues::LatestValue<std::uint32_t> value_;
};

/// One thread does both sides: the instructions alone.
template <class Exchange>
void push_and_pop(benchmark::State& state) {
  Exchange exchange;
  std::uint32_t value = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(exchange.push(value));
    benchmark::DoNotOptimize(exchange.pop(value));
  }
}
BENCHMARK_TEMPLATE(push_and_pop, OurQueue);
BENCHMARK_TEMPLATE(push_and_pop, BoostQueue);
BENCHMARK_TEMPLATE(push_and_pop, OurLatestValue);

/// A value goes to another thread and its answer comes back: twice the delay of one hand-over.
template <class Exchange>
void to_another_thread_and_back(benchmark::State& state) {
  Exchange there;
  Exchange back;
  std::atomic<bool> stop{false};
  std::thread echo([&] {
    std::uint32_t value = 0;
    while (!stop.load(std::memory_order_relaxed)) {
      if (there.pop(value)) (void)back.push(value);
    }
  });
  std::uint32_t value = 0;
  for (auto _ : state) {
    (void)there.push(value);
    while (!back.pop(value)) {
    }
  }
  stop.store(true, std::memory_order_relaxed);
  echo.join();
}
BENCHMARK_TEMPLATE(to_another_thread_and_back, OurQueue)->UseRealTime();
BENCHMARK_TEMPLATE(to_another_thread_and_back, BoostQueue)->UseRealTime();
BENCHMARK_TEMPLATE(to_another_thread_and_back, OurLatestValue)->UseRealTime();

/// As many values as will go through: here the copies of the opposite counts pay.
template <class Queue>
void stream_to_another_thread(benchmark::State& state) {
  Queue queue;
  std::atomic<bool> stop{false};
  std::thread consumer([&] {
    std::uint32_t value = 0;
    while (!stop.load(std::memory_order_relaxed)) benchmark::DoNotOptimize(queue.pop(value));
  });
  std::uint32_t value = 0;
  for (auto _ : state) {
    while (!queue.push(value)) {
    }
    ++value;
  }
  stop.store(true, std::memory_order_relaxed);
  consumer.join();
}
BENCHMARK_TEMPLATE(stream_to_another_thread, OurQueue)->UseRealTime();
BENCHMARK_TEMPLATE(stream_to_another_thread, BoostQueue)->UseRealTime();

}  // namespace
}  // namespace terracut
