// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/stream_tracker.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace terracut::decode {
namespace {

constexpr std::int64_t kWrap_us = 3'600'000'000;
constexpr std::int64_t kPeriod_us = 288;
constexpr std::int32_t kSweep_cdeg = 104;

/// Packet `n` of a head at 10 Hz, 6 firings a packet.
packet::PacketAzimuths packet(std::int64_t n, std::int64_t first_us = 0) {
  packet::PacketAzimuths azimuths;
  azimuths.device_stamp_us = (first_us + n * kPeriod_us) % kWrap_us;
  azimuths.nominal_period_ns = kPeriod_us * 1000;
  azimuths.shortest_period_ns = 252'000;
  azimuths.longest_period_ns = 388'800;
  azimuths.columns = 1;
  azimuths.azimuth_cdeg[0] = beams::wrap_cdeg(n * kSweep_cdeg);
  azimuths.step_ticks = kSweep_cdeg * packet::kTicksPerCdeg / 6;
  azimuths.sweep_ticks = azimuths.pace_ticks = kSweep_cdeg * packet::kTicksPerCdeg;
  return azimuths;
}

class Tracked : public testing::Test {
 protected:
  Placement place(const packet::PacketAzimuths& azimuths, std::int64_t host_ns = 0) {
    const Placement placed = tracker.place(azimuths, host_ns, next_cdeg, losses);
    if (placed.arrival == Arrival::kNext) {
      tracker.miss(placed.missing, losses);
      next_cdeg = placed.rotor_cdeg + kSweep_cdeg;
    }
    return placed;
  }
  void place_all(std::int64_t from, std::int64_t to, std::int64_t first_us = 0) {
    for (std::int64_t n = from; n < to; ++n) (void)place(packet(n, first_us));
  }

  memory::FixedMemory memory;
  StreamTracker tracker{kWrap_us, memory};
  frame::LossCounters losses;
  std::int64_t next_cdeg = 0;
};

TEST_F(Tracked, ASwapAmongTheFirstPacketsIsNoLoss) {
  for (const std::int64_t n : {0, 1, 3, 2, 4, 6, 7, 5}) {
    EXPECT_NE(place(packet(n)).arrival, Arrival::kRejected) << n;
  }
  place_all(8, 60);
  tracker.end_of_stream(losses);
  EXPECT_EQ(losses.network_gap_packets, 0U);
}

TEST_F(Tracked, APacketThatComesThreeTooLateIsNoLoss) {
  place_all(0, 50);
  for (const std::int64_t n : {51, 52, 53, 50}) (void)place(packet(n));
  place_all(54, 100);
  tracker.end_of_stream(losses);
  EXPECT_EQ(losses.network_gap_packets, 0U);
}

TEST_F(Tracked, ASwapAndALossAmongTheFirstPacketsIsOneLoss) {
  for (const std::int64_t n : {0, 1, 3, 2, 4, 6, 7}) (void)place(packet(n));
  place_all(8, 60);
  tracker.end_of_stream(losses);
  EXPECT_EQ(losses.network_gap_packets, 1U);
}

TEST_F(Tracked, APacketThatIsLateAcrossTheHourIsReordered) {
  const std::int64_t first_us = kWrap_us - 20 * kPeriod_us;
  place_all(0, 19, first_us);
  (void)place(packet(20, first_us));  // the first of the hour
  const Placement late = place(packet(19, first_us));
  EXPECT_EQ(late.arrival, Arrival::kReordered);
  EXPECT_EQ(late.rotor_cdeg, 19 * kSweep_cdeg);
  place_all(21, 60, first_us);
  tracker.end_of_stream(losses);
  EXPECT_EQ(losses.clock_jumps, 0U);
  EXPECT_EQ(losses.network_gap_packets, 0U);
}

TEST_F(Tracked, WhereEverySecondPacketIsLostFromTheStartTheyAreCounted) {
  for (std::int64_t n = 0; n <= 200; n += 2) (void)place(packet(n));
  tracker.end_of_stream(losses);
  EXPECT_EQ(tracker.period_ns(), 0) << "no sensor's";
  EXPECT_EQ(losses.network_gap_packets, 100U);
}

TEST_F(Tracked, LossesAreToldWithinSomePacketsWhereThePeriodIsNoSensors) {
  std::int64_t stamp_us = 0;
  for (std::int64_t n = 0; n < 100; ++n) {
    packet::PacketAzimuths azimuths = packet(n);
    azimuths.device_stamp_us = stamp_us += n == 20 ? 2 * kPeriod_us : 2;
    (void)place(azimuths);
  }
  EXPECT_EQ(tracker.period_ns(), 0);
  EXPECT_EQ(losses.network_gap_packets, 1U);
}

TEST_F(Tracked, ASwitchToDualReturnAndBackLosesNothing) {
  std::int64_t stamp_us = 0, rotor_cdeg = 0;
  for (int n = 0; n < 300; ++n) {
    packet::PacketAzimuths azimuths = packet(0);
    const bool dual = n >= 100 && n < 200;
    if (dual) {
      azimuths.nominal_period_ns = 172'800;
      azimuths.shortest_period_ns = 151'200;
      azimuths.longest_period_ns = 194'400;
      azimuths.sweep_ticks = azimuths.pace_ticks = 62'000;
    }
    stamp_us += dual ? 173 : 288;
    rotor_cdeg += dual ? 62 : 104;
    azimuths.device_stamp_us = stamp_us;
    azimuths.azimuth_cdeg[0] = beams::wrap_cdeg(rotor_cdeg);
    EXPECT_NE(place(azimuths).arrival, Arrival::kRejected) << n;
  }
  tracker.end_of_stream(losses);
  EXPECT_EQ(losses.network_gap_packets, 0U);
  EXPECT_NEAR(static_cast<double>(tracker.period_ns()), 288'000, 100);
}

TEST_F(Tracked, PacketsLostWhileTheHeadStandsAreCounted) {
  place_all(0, 50);
  for (const std::int64_t n : {50, 51, 54, 55}) {
    tracker.note_stationary(packet(n).device_stamp_us, packet(50).azimuth_cdeg[0], losses);
  }
  packet::PacketAzimuths next = packet(50);
  next.device_stamp_us = packet(56).device_stamp_us;
  (void)place(next);
  tracker.end_of_stream(losses);
  EXPECT_EQ(losses.network_gap_packets, 2U);
}

TEST_F(Tracked, AHeadThatHasStoodIsExpectedWhereItStands) {
  place_all(0, 50);
  tracker.note_stationary(packet(50).device_stamp_us, packet(50).azimuth_cdeg[0], losses);
  packet::PacketAzimuths next = packet(50);
  next.device_stamp_us = packet(200).device_stamp_us;
  EXPECT_EQ(place(next).arrival, Arrival::kNext);
}

TEST_F(Tracked, ARebootIsFollowedWhereFewerPacketsShowAtOnceThanBearOutAStream) {
  constexpr int kPacketsAFrame = 346, kInView = StreamTracker::kNewStream_packets / 2;
  const auto is_in_view = [](std::int64_t n) { return n % kPacketsAFrame < kInView; };
  place_all(0, kInView);
  std::int64_t agreed = 0;
  for (std::int64_t n = 0; n < 4 * kPacketsAFrame; ++n) {
    if (!is_in_view(n)) continue;
    const Placement placed = place(packet(n, kWrap_us / 2));
    agreed += placed.arrival == Arrival::kDoubtful ? 1 : 0;
    if (placed.arrival == Arrival::kNewStream) {
      EXPECT_EQ(agreed, StreamTracker::kNewStream_packets - 1);
      return;
    }
  }
  ADD_FAILURE() << "never followed; in doubt: " << agreed;
}

TEST_F(Tracked, PacketsThatDoNotTakeTheirTimeBearOutNoStream) {
  place_all(0, 20);
  for (std::int64_t n = 0; n < 100; ++n) {  // a frame of stamps in each microsecond of the host's
    const Placement placed = place(packet(346 * n, kWrap_us / 2), 1 + n * 1000);
    EXPECT_EQ(placed.arrival, Arrival::kDoubtful) << n;
  }
}

TEST_F(Tracked, HostStampsMayBeAnything) {
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t n = 0; n < 64; ++n) {
    (void)place(packet(n, n * 700'000'000), n % 2 == 0 ? kLeast : kMost);
  }
  EXPECT_EQ(losses.network_gap_packets, 0U);
  EXPECT_EQ(losses.clock_jumps, 63U);
}

}  // namespace
}  // namespace terracut::decode
