// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/host_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace terracut::decode {
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
    const HostClock::Sent sent = clock.sent(i * kPacket_us, left_ns + delay_ns);
    EXPECT_FALSE(sent.anew);
    worst_ns = std::max(worst_ns, std::abs(sent.instant_ns - left_ns));
  }
  EXPECT_LT(worst_ns, 20'000);
}

TEST(HostClock, FollowsClocksThatRunApartOrAreSlewed) {
  for (const double apart : {100e-6, -100e-6, 600e-6, -600e-6}) {
    HostClock clock(kHour_us);
    for (std::int64_t i = 0; i < 1'000'000; ++i) {  // for 288 s
      const std::int64_t arrived_ns =
          kStart_ns + std::llround(static_cast<double>(i * kPacket_us * 1000) * (1 + apart));
      const HostClock::Sent sent = clock.sent(i * kPacket_us % kHour_us, arrived_ns);
      ASSERT_NEAR(static_cast<double>(sent.instant_ns - arrived_ns), 0, 1.0);
      ASSERT_FALSE(sent.anew) << i;
    }
  }
}

/// What it says of a packet that is nothing but the next one.
HostClock::Sent next(HostClock& clock, std::int64_t device_us, std::int64_t arrived_ns) {
  const HostClock::Sent sent = clock.sent(device_us, arrived_ns);
  EXPECT_FALSE(sent.anew);
  return sent;
}

/// It begins anew with this packet, at the time of its arrival.
void expect_anew(HostClock& clock, std::int64_t device_us, std::int64_t arrived_ns) {
  const HostClock::Sent sent = clock.sent(device_us, arrived_ns);
  EXPECT_TRUE(sent.anew);
  EXPECT_EQ(sent.instant_ns, arrived_ns);
}

TEST(HostClock, TheDeviceClockMayWrapAndBeSet) {
  HostClock clock(kHour_us);
  EXPECT_EQ(next(clock, kHour_us - 100, kStart_ns).instant_ns, kStart_ns);
  EXPECT_EQ(next(clock, 188, kStart_ns + 288'000).instant_ns, kStart_ns + 288'000);
  expect_anew(clock, 188 + 40'000'000, kStart_ns + 600'000);
  expect_anew(clock, 188 + 30'000'000, kStart_ns + 900'000);
}

TEST(HostClock, TheHostClockMayBeSetByAnything) {
  for (const std::int64_t set_ns : {21'000'000LL, 100'000'000LL, 3'600'000'000'000LL, -3'000'000LL,
                                    -20'000'000LL, -100'000'000LL, -3'600'000'000'000LL}) {
    HostClock clock(kHour_us);
    (void)next(clock, 0, kStart_ns);
    expect_anew(clock, 288, kStart_ns + set_ns);
    EXPECT_EQ(next(clock, 576, kStart_ns + set_ns + 288'000).instant_ns,
              kStart_ns + set_ns + 288'000);
  }
}

TEST(HostClock, PacketsThatAreAtMostTwentyMillisecondsLateAreNoStep) {
  HostClock clock(kHour_us);
  (void)next(clock, 0, kStart_ns);
  EXPECT_LT(next(clock, 288, kStart_ns + 288'000 + 20'000'000).instant_ns, kStart_ns + 289'000);
  EXPECT_EQ(next(clock, 576, kStart_ns + 576'000).instant_ns, kStart_ns + 576'000);
}

TEST(HostClock, SmallCorrectionsThatAddUpAreAStepUnlessTheyAreFarApart) {
  const auto steps = [](std::int64_t device_step_us) {
    HostClock clock(kHour_us);
    int anew = 0;
    std::int64_t earlier_ns = 0;
    for (std::int64_t i = 0; i < 40; ++i) {
      earlier_ns += 1'000'000;
      const std::int64_t device_us = i * device_step_us;
      anew += clock.sent(device_us, kStart_ns + device_us * 1000 - earlier_ns).anew ? 1 : 0;
    }
    return anew;
  };
  EXPECT_EQ(steps(288), 13);       // every 3 ms
  EXPECT_EQ(steps(1'000'000), 0);  // a clock that is 1000 ppm slow
}

TEST(HostClock, KnowsNothingOfAStreamThatItIsToReset) {
  HostClock clock(kHour_us);
  (void)next(clock, 0, kStart_ns);
  clock.reset();
  EXPECT_EQ(next(clock, 288, kStart_ns - 5'000'000'000).instant_ns, kStart_ns - 5'000'000'000);
}

TEST(HostClock, TheDeviceClockMayBeSetByMoreThanNanosecondsCanCount) {
  constexpr std::int64_t kWrap_us = std::int64_t{1} << 56;  // an RS-Ruby128's
  HostClock clock(kWrap_us);
  (void)next(clock, 1'000'000, kStart_ns);
  expect_anew(clock, 999'000, kStart_ns + 50'000);
  expect_anew(clock, kWrap_us - 1, kStart_ns + 90'000);
}

}  // namespace
}  // namespace terracut::decode
