// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/motion/host_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace terracut::firmware_io {
namespace {

constexpr std::int64_t kHour_us = 3'600'000'000;
constexpr std::int64_t kPacket_us = 288;
constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

TEST(HostClock, PacketsThatArriveLateAreGivenTheTimeTheyLeftAt) {
  HostClock clock(kHour_us);
  std::int64_t worst_ns = 0;
  for (std::int64_t i = 0; i < 5000; ++i) {
    // Every 50th is in time, the others are up to 5 ms late.
    const std::int64_t delay_ns = i % 50 == 0 ? 0 : (i * 7919 % 5000) * 1000;
    const std::int64_t left_ns = kStart_ns + i * kPacket_us * 1000;
    worst_ns =
        std::max(worst_ns, std::abs(clock.sent_ns(i * kPacket_us, left_ns + delay_ns) - left_ns));
  }
  EXPECT_LT(worst_ns, 10'000);
}

TEST(HostClock, FollowsClocksThatRunApart) {
  for (const double drift : {100e-6, -100e-6}) {
    HostClock clock(kHour_us);
    for (std::int64_t i = 0; i < 100'000; ++i) {
      const std::int64_t arrived_ns =
          kStart_ns + std::llround(static_cast<double>(i * kPacket_us * 1000) * (1 + drift));
      ASSERT_NEAR(static_cast<double>(clock.sent_ns(i * kPacket_us, arrived_ns) - arrived_ns), 0,
                  1.0);
    }
  }
}

TEST(HostClock, TheDeviceClockMayWrapAndBeSet) {
  HostClock clock(kHour_us);
  EXPECT_EQ(clock.sent_ns(kHour_us - 100, kStart_ns), kStart_ns);
  EXPECT_EQ(clock.sent_ns(188, kStart_ns + 288'000), kStart_ns + 288'000);
  EXPECT_EQ(clock.sent_ns(188 + 40'000'000, kStart_ns + 600'000), kStart_ns + 600'000);
  EXPECT_EQ(clock.sent_ns(188 + 30'000'000, kStart_ns + 900'000), kStart_ns + 900'000);
}

TEST(HostClock, TheHostClockMayBeSetToo) {
  HostClock clock(kHour_us);
  EXPECT_EQ(clock.sent_ns(0, kStart_ns), kStart_ns);
  EXPECT_EQ(clock.sent_ns(288, kStart_ns + 3'000'000'000), kStart_ns + 3'000'000'000);
  EXPECT_EQ(clock.sent_ns(576, kStart_ns + 500'000'000), kStart_ns + 500'000'000);
}

TEST(HostClock, TheDeviceClockMayBeSetByMoreThanNanosecondsCanCount) {
  constexpr std::int64_t kWrap_us = std::int64_t{1} << 56;  // an RS-Ruby128's
  HostClock clock(kWrap_us);
  EXPECT_EQ(clock.sent_ns(1'000'000, kStart_ns), kStart_ns);
  EXPECT_EQ(clock.sent_ns(999'000, kStart_ns + 50'000), kStart_ns + 50'000);
  EXPECT_EQ(clock.sent_ns(kWrap_us - 1, kStart_ns + 90'000), kStart_ns + 90'000);
}

}  // namespace
}  // namespace terracut::firmware_io
