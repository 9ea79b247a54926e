// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/frame_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

namespace terracut::live {
namespace {

using Slots = FramePool<int>;

/// Passes on a frame of `number` returns, all of them `number`.
void pass_on(Slots& slots, std::uint32_t number) {
  status::FrameRecord record;
  record.info.number = number;
  record.info.returns = number;
  record.labels_ns = number;
  slots.pass_on(record, record.info.returns, [&](std::span<int> room) noexcept {
    std::fill_n(room.begin(), number, static_cast<int>(number));
  });
}

TEST(FramePoolTest, BringFramesInOrderWithTheirItems) {
  memory::FixedMemory memory;
  Slots slots("slots", 4, 10, memory);
  Slots::Frame frame;
  EXPECT_FALSE(slots.take(frame));
  pass_on(slots, 3);
  pass_on(slots, 10);
  for (const std::uint32_t number : {3U, 10U}) {
    ASSERT_TRUE(slots.take(frame));
    EXPECT_EQ(frame.record.info.number, number);
    EXPECT_EQ(frame.record.labels_ns, number);
    EXPECT_EQ(frame.items.size(), number);
    EXPECT_TRUE(
        std::ranges::all_of(frame.items, [&](int i) { return i == static_cast<int>(number); }));
    slots.give_back(true);
  }
  EXPECT_FALSE(slots.take(frame));
  EXPECT_EQ(slots.unused(), 0U);
  EXPECT_EQ(slots.waiting(), 0U);
}

TEST(FramePoolTest, BringHeightsWhereTheyAreKept) {
  memory::FixedMemory memory;
  const std::array heights_m{1.0F, 2.0F, 3.0F};
  for (const Slots::Heights heights : {Slots::Heights::kKept, Slots::Heights::kLeftOut}) {
    Slots slots("slots", 1, 10, memory, heights);
    Slots::Frame frame;
    slots.pass_on(
        {}, 3, [](std::span<int> room) noexcept { std::ranges::fill(room, 7); }, heights_m);
    ASSERT_TRUE(slots.take(frame));
    EXPECT_EQ(frame.items.size(), 3U);
    EXPECT_EQ(std::ranges::equal(frame.heights_m, heights_m), heights == Slots::Heights::kKept);
    slots.give_back(true);
    pass_on(slots, 2);
    ASSERT_TRUE(slots.take(frame));
    EXPECT_TRUE(frame.heights_m.empty());
  }
}

TEST(FramePoolTest, CountWhatFoundNoRoomAndKeepWhatHadRoom) {
  memory::FixedMemory memory;
  Slots slots("slots", 2, 10, memory);
  for (std::uint32_t number = 1; number <= 5; ++number) pass_on(slots, number);
  EXPECT_EQ(slots.unused(), 3U);
  EXPECT_EQ(slots.waiting(), 2U);
  Slots::Frame frame;
  ASSERT_TRUE(slots.take(frame));
  EXPECT_EQ(frame.record.info.number, 1U);
  EXPECT_EQ(slots.waiting(), 2U) << "until it is given back";
  slots.give_back(true);
  pass_on(slots, 6);
  ASSERT_TRUE(slots.take(frame));
  EXPECT_EQ(frame.record.info.number, 2U);
  slots.give_back(true);
  ASSERT_TRUE(slots.take(frame));
  EXPECT_EQ(frame.record.info.number, 6U);
}

TEST(FramePoolTest, CountWhatIsGivenBackUnused) {
  memory::FixedMemory memory;
  Slots slots("slots", 2, 10, memory);
  Slots::Frame frame;
  for (std::uint32_t number = 1; number <= 5; ++number) {
    pass_on(slots, number);
    ASSERT_TRUE(slots.take(frame));
    slots.give_back(number % 2 == 0);
  }
  EXPECT_EQ(slots.unused(), 3U);
}

TEST(FramePoolTest, LoseNoFrameUncountedBetweenTwoThreads) {
  constexpr std::uint32_t kFrames = 20'000;
  memory::FixedMemory memory;
  Slots slots("slots", 3, kFrames, memory);
  std::atomic<bool> over = false;
  std::uint64_t taken = 0;
  std::thread other([&] {
    std::uint32_t newest = 0;
    while (true) {
      const bool last_round = over;
      for (Slots::Frame frame; slots.take(frame); slots.give_back(true), ++taken) {
        EXPECT_GT(frame.record.info.number, newest);
        newest = frame.record.info.number;
        EXPECT_EQ(frame.items.back(), static_cast<int>(newest));
      }
      if (last_round) return;
    }
  });
  for (std::uint32_t number = 1; number <= kFrames; ++number) {
    status::FrameRecord record;
    record.info.number = number;
    record.info.returns = 4;
    slots.pass_on(record, record.info.returns, [&](std::span<int> room) noexcept {
      std::fill_n(room.begin(), 4, static_cast<int>(number));
    });
  }
  over = true;
  other.join();
  EXPECT_EQ(taken + slots.unused(), kFrames);
  EXPECT_EQ(slots.waiting(), 0U);
}

}  // namespace
}  // namespace terracut::live
