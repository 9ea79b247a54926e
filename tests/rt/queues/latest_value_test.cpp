// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/queues/latest_value.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <thread>

namespace terracut::queues {
namespace {

TEST(LatestValue, HasNothingNewBeforeTheFirstPublication) {
  LatestValue<int> exchange;
  EXPECT_EQ(exchange.take_if_new(), nullptr);
  EXPECT_EQ(exchange.newest_taken(), 0);
}

TEST(LatestValue, GivesEveryValueOnce) {
  LatestValue<int> exchange;
  exchange.publish(5);
  const int* taken = exchange.take_if_new();
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(*taken, 5);
  EXPECT_EQ(exchange.take_if_new(), nullptr);
  EXPECT_EQ(exchange.newest_taken(), 5);
}

TEST(LatestValue, GivesTheNewestAndTellsTheWriterWhatWasMissed) {
  LatestValue<int> exchange;
  EXPECT_FALSE(exchange.publish(1));
  EXPECT_TRUE(exchange.publish(2));
  EXPECT_TRUE(exchange.publish(3));
  const int* taken = exchange.take_if_new();
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(*taken, 3);
  EXPECT_FALSE(exchange.publish(4)) << "3 had been taken";
}

TEST(LatestValue, LeavesTheTakenValueAloneHoweverMuchIsPublished) {
  LatestValue<int> exchange;
  exchange.publish(1);
  const int* taken = exchange.take_if_new();
  ASSERT_NE(taken, nullptr);
  for (int n = 2; n < 10; ++n) exchange.publish(n);
  EXPECT_EQ(*taken, 1);
  EXPECT_EQ(exchange.newest_taken(), 1);
}

TEST(LatestValue, LetsTheWriterFillInPlace) {
  LatestValue<std::string> exchange;  // any type, not only trivially copyable ones
  exchange.draft() = "a status";
  exchange.publish();
  const std::string* taken = exchange.take_if_new();
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(*taken, "a status");
}

TEST(LatestSlot, NeverGivesOneSlotToBothSides) {
  LatestSlot slots;
  std::mt19937 random(11);
  std::set<std::size_t> used;
  for (int step = 0; step < 10'000; ++step) {
    if (random() % 2 == 0) {
      const std::size_t filled = slots.writer_slot();
      slots.publish();
      ASSERT_NE(slots.writer_slot(), filled) << "it now belongs to the reader's side";
    } else {
      (void)slots.take_if_new();
    }
    ASSERT_LT(slots.writer_slot(), LatestSlot::kSlots);
    ASSERT_LT(slots.reader_slot(), LatestSlot::kSlots);
    ASSERT_NE(slots.writer_slot(), slots.reader_slot());
    used.insert(slots.writer_slot());
  }
  EXPECT_EQ(used.size(), LatestSlot::kSlots);
}

/// Words that belong together: a value read half before and half after a write shows.
struct Wide {
  std::array<std::uint64_t, 16> words{};
  void fill(std::uint64_t number) {
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = number * (2 * i + 1);
  }
  [[nodiscard]] bool whole() const {
    Wide expected;
    expected.fill(words[0]);
    return words == expected.words;
  }
};

TEST(LatestValue, IsWholeInOrderAndEndsWithTheLastBetweenTwoThreads) {
  constexpr std::uint64_t kValues = 2'000'000;
  LatestValue<Wide> exchange;
  std::atomic<bool> reader_is_ready{false};
  std::uint64_t missed = 0;  // the writer's, read after the join
  std::thread writer([&] {
    while (!reader_is_ready.load(std::memory_order_relaxed)) std::this_thread::yield();
    for (std::uint64_t number = 1; number <= kValues; ++number) {
      exchange.draft().fill(number);
      missed += exchange.publish() ? 1 : 0;
    }
  });
  std::uint64_t torn = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t taken = 0;
  std::uint64_t last = 0;
  reader_is_ready.store(true, std::memory_order_relaxed);
  while (last < kValues) {  // the last value must arrive, or this never ends
    const Wide* value = exchange.take_if_new();
    if (value == nullptr) {
      std::this_thread::yield();
      continue;
    }
    torn += value->whole() ? 0 : 1;
    out_of_order += value->words[0] > last ? 0 : 1;
    last = value->words[0];
    ++taken;
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(out_of_order, 0U);
  EXPECT_EQ(taken + missed, kValues) << "every value is either taken or counted as missed";
  EXPECT_EQ(exchange.take_if_new(), nullptr);
}

}  // namespace
}  // namespace terracut::queues
