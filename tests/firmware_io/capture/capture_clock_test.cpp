// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/capture_clock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace terracut::capture {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kMs = 1'000'000, kNow_ns = 1'767'225'600'000 * kMs;

/// Milliseconds since the first packet, of packets with stamps so many milliseconds from now.
std::vector<std::int64_t> times_ms(CaptureClock& clock, const std::vector<std::int64_t>& stamps) {
  std::vector<std::int64_t> times;
  for (const std::int64_t stamp : stamps) times.push_back(clock.add(kNow_ns + stamp * kMs) / kMs);
  return times;
}

TEST(CaptureClock, IsTheStampsWhereTheyAdvance) {
  CaptureClock clock;
  EXPECT_THAT(times_ms(clock, {0, 1, 2, 3000, 3'600'000}), ElementsAre(0, 1, 2, 3000, 3'600'000));
  EXPECT_EQ(clock.steps_back(), 0U);
}

TEST(CaptureClock, LeavesPacketsThatAreALittleOutOfOrderTheirTimes) {
  CaptureClock clock;
  EXPECT_THAT(times_ms(clock, {10, 8, 9, 20, 19, 30}), ElementsAre(0, -2, -1, 10, 9, 20));
  EXPECT_EQ(clock.steps_back(), 0U);
}

TEST(CaptureClock, GoesOnFromWhereItWasWhenTheStampsStepBack) {
  CaptureClock clock;
  EXPECT_THAT(times_ms(clock, {0, 500, 1000, -1000, -999, -500}),
              ElementsAre(0, 500, 1000, 1000, 1001, 1500));
  EXPECT_EQ(clock.steps_back(), 1U);
  EXPECT_EQ(clock.longest_step_back_ns(), 2000 * kMs);
  EXPECT_EQ(clock.since_begin_ns(kNow_ns - 400 * kMs), 1600 * kMs);
}

TEST(CaptureClock, BeginsWithTheSecondPacketWhereTheFirstIsFromTheFuture) {
  CaptureClock clock;
  EXPECT_THAT(times_ms(clock, {3'600'000, 0, 1, 50}), ElementsAre(0, 0, 1, 50));
}

TEST(CaptureClock, ForgetsAStampThatRanAheadAlone) {
  CaptureClock clock;
  EXPECT_THAT(times_ms(clock, {0, 1, 2, 3'600'000, 3, 4}), ElementsAre(0, 1, 2, 3'600'000, 3, 4));
}

TEST(CaptureClock, CountsWithoutOverflowWhateverTheStamps) {
  std::mt19937_64 random(1);
  CaptureClock clock;
  for (int i = 0; i < 100'000; ++i) {
    const auto stamp = static_cast<std::int64_t>(random() % 9'000'000'000'999'999'999U);
    const std::int64_t since_ns = clock.add(i % 3 == 0 ? stamp % 1000 : stamp);
    ASSERT_GE(since_ns, -CaptureClock::kDisorder_ns);
    (void)clock.since_begin_ns(9'000'000'000'999'999'999);
    (void)clock.since_begin_ns(0);
  }
}

}  // namespace
}  // namespace terracut::capture
