// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/queues/spsc_queue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <deque>
#include <random>
#include <thread>

#include "tests/support/allocation_counter.hpp"

namespace terracut::queues {
namespace {

TEST(SpscQueue, GivesValuesBackInOrder) {
  memory::FixedMemory memory;
  SpscQueue<int> queue("queue", 3, memory);
  EXPECT_TRUE(queue.try_push(1));
  EXPECT_TRUE(queue.try_push(2));
  int value = 0;
  EXPECT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 1);
  EXPECT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 2);
}

TEST(SpscQueue, RefusesWhenEmptyAndLeavesTheValueAlone) {
  memory::FixedMemory memory;
  SpscQueue<int> queue("queue", 3, memory);
  int value = 7;
  EXPECT_FALSE(queue.try_pop(value));
  EXPECT_EQ(value, 7);
}

TEST(SpscQueue, HoldsExactlyItsCapacityEvenIfThatIsNoPowerOfTwo) {
  for (const std::size_t capacity : {0U, 1U, 2U, 3U, 5U, 8U, 100U}) {
    memory::FixedMemory memory;
    SpscQueue<std::size_t> queue("queue", capacity, memory);
    for (std::size_t n = 0; n < capacity; ++n) {
      EXPECT_TRUE(queue.try_push(n)) << n << " of " << capacity;
      EXPECT_EQ(queue.size_approx(), n + 1);
    }
    EXPECT_FALSE(queue.try_push(capacity)) << capacity;
    for (std::size_t n = 0; n < capacity; ++n) {
      std::size_t value = 0;
      EXPECT_TRUE(queue.try_pop(value));
      EXPECT_EQ(value, n);
    }
    std::size_t value = 0;
    EXPECT_FALSE(queue.try_pop(value)) << capacity;
  }
}

TEST(SpscQueue, TakesItsRoomUnderItsName) {
  memory::FixedMemory memory;
  const SpscQueue<std::uint32_t> queue("free frames", 20, memory);
  ASSERT_EQ(memory.parts().size(), 1U);
  EXPECT_EQ(memory.parts()[0].name, "free frames");
  EXPECT_EQ(memory.parts()[0].bytes, 32U * 4);
}

TEST(SpscQueue, BehavesLikeAPlainQueueUnderAnyMixtureOfCalls) {
  std::mt19937 random(5);
  for (const std::size_t capacity : {1U, 3U, 4U, 7U}) {
    memory::FixedMemory memory;
    SpscQueue<std::uint32_t> queue("queue", capacity, memory);
    std::deque<std::uint32_t> plain;
    for (int step = 0; step < 20'000; ++step) {
      // Phases that mostly push and phases that mostly pop, so that both ends are met often.
      if (random() % 4 < (step / 50 % 2 == 0 ? 3U : 1U)) {
        const auto value = static_cast<std::uint32_t>(random());
        const bool has_room = plain.size() < capacity;
        ASSERT_EQ(queue.try_push(value), has_room);
        if (has_room) plain.push_back(value);
      } else {
        std::uint32_t value = 0;
        ASSERT_EQ(queue.try_pop(value), !plain.empty());
        if (plain.empty()) continue;
        ASSERT_EQ(value, plain.front());
        plain.pop_front();
      }
      ASSERT_EQ(queue.size_approx(), plain.size());
    }
  }
}

/// Eight words that belong together: a value read half before and half after a write shows.
struct Wide {
  std::array<std::uint64_t, 8> words;
  static Wide of(std::uint64_t number) {
    Wide wide{};
    for (std::size_t i = 0; i < wide.words.size(); ++i) wide.words[i] = number * (2 * i + 1);
    return wide;
  }
  bool operator==(const Wide&) const = default;
};

TEST(SpscQueue, LosesRepeatsAndTearsNothingBetweenTwoThreads) {
  constexpr std::uint64_t kValues = 1'000'000;
  for (const std::size_t capacity : {1U, 3U, 256U}) {
    // A small queue changes thread with every value or two, which is slow where threads share a
    // core.
    const std::uint64_t values = capacity < 4 ? kValues / 20 : kValues;
    memory::FixedMemory memory;
    SpscQueue<Wide> queue("queue", capacity, memory);
    std::thread producer([&] {
      for (std::uint64_t number = 0; number < values; ++number) {
        const Wide value = Wide::of(number);
        while (!queue.try_push(value)) std::this_thread::yield();
      }
    });
    std::uint64_t wrong = 0;
    std::uint64_t too_full = 0;
    for (std::uint64_t number = 0; number < values; ++number) {
      Wide value{};
      while (!queue.try_pop(value)) std::this_thread::yield();
      wrong += value == Wide::of(number) ? 0 : 1;
      too_full += queue.size_approx() <= capacity ? 0 : 1;
    }
    producer.join();
    EXPECT_EQ(wrong, 0U) << "capacity " << capacity;
    EXPECT_EQ(too_full, 0U) << "capacity " << capacity;
    EXPECT_EQ(queue.size_approx(), 0U);
  }
}

/// The use it is made for: slots of a pool go to the other thread full and come back empty.
TEST(SpscQueue, PassesTheSlotsOfAPoolToAndFro) {
  constexpr std::size_t kSlots = 4;
  constexpr std::uint64_t kFrames = 300'000;
  memory::FixedMemory memory;
  SpscQueue<std::uint32_t> full("full", kSlots, memory);
  SpscQueue<std::uint32_t> free("free", kSlots, memory);
  std::array<Wide, kSlots> pool{};  // plain memory: only the queues order its accesses
  for (std::uint32_t slot = 0; slot < kSlots; ++slot) ASSERT_TRUE(free.try_push(slot));

  std::thread producer([&] {
    for (std::uint64_t number = 0; number < kFrames; ++number) {
      std::uint32_t slot = 0;
      while (!free.try_pop(slot)) std::this_thread::yield();
      pool[slot] = Wide::of(number);
      while (!full.try_push(slot)) std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    std::uint32_t slot = 0;
    while (!full.try_pop(slot)) std::this_thread::yield();
    wrong += pool[slot] == Wide::of(number) ? 0 : 1;
    while (!free.try_push(slot)) std::this_thread::yield();
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(free.size_approx(), kSlots);
}

TEST(SpscQueue, AllocatesNothingAfterItsConstruction) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "the sanitizer brings its own allocator";
  memory::FixedMemory memory;
  SpscQueue<int> queue("queue", 16, memory);
  const std::uint64_t before = test::allocations_of_this_thread();
  int value = 0;
  bool all = true;
  for (int n = 0; n < 1000; ++n) all = queue.try_push(n) && queue.try_pop(value) && all;
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_TRUE(all);
}

}  // namespace
}  // namespace terracut::queues
