// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Whatever becomes of a stream on its way, everything of it is in exactly one place.
#include <gtest/gtest.h>

#include <utility>

#include "heard_stream.hpp"

namespace terracut::test {
namespace {

using frame::Reject;

template <class Sensor>
class BentStream : public testing::Test {
 protected:
  /// Every laser of every packet has a return, so that packets tell how many returns there are.
  static constexpr std::uint64_t kReturnsAPacket = Sensor::kColumns * Sensor::kLasers;

  static void expect_all_accounted_for(HeardStream<Sensor>& stream) {
    stream.flush();
    EXPECT_EQ(stream.packets_unaccounted(), 0);
    EXPECT_EQ(stream.decoder.packets_kept(), 0U);
    EXPECT_EQ(stream.returns_handed_over + stream.decoder.losses().overflow_full_returns,
              stream.decoder.packets_decoded() * kReturnsAPacket);
  }
  static void set_stamp(Payload& payload, std::int64_t stamp_ns) {
    Sensor::set_clock(payload.bytes, stamp_ns);
  }
  Head<Sensor> head{.share_of_returns = 1};
};

using EverySensor =
    testing::Types<reference::Hdl64e, reference::Ruby128, reference::Hdl32e, reference::Vlp32c>;
TYPED_TEST_SUITE(BentStream, EverySensor);

TYPED_TEST(BentStream, LosesNothingWithoutNamingIt) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    auto config = HeardStream<TypeParam>::hasty();
    config.reorder_packets = static_cast<int>(seed % 3);
    config.returns_per_cell = 2;
    HeardStream<TypeParam> stream(config);
    for (int piece = 0; piece < 8; ++piece) {
      const Head<TypeParam> rotating{.spin_hz = std::array{5.0, 10.0, 20.0}[random() % 3],
                                     .dual_return = random() % 2 == 0,
                                     .share_of_returns = 1};
      auto packets = rotating.frames(0.1 + 0.1 * static_cast<double>(random() % 15));
      const std::int64_t stamp_off_ns = static_cast<std::int64_t>(random() % 4) * 1'700'000'000;
      const auto trouble = random() % 7;
      const std::size_t silent = packets.size() * (random() % 3) / 4;
      for (std::size_t n = 0; n < packets.size(); ++n) {
        Payload& packet = packets[n];
        this->set_stamp(packet, packet.stamp_ns + stamp_off_ns);
        const bool hit = random() % 9 == 0;
        if (hit && trouble == 0 && n + 3 < packets.size()) std::swap(packet, packets[n + 3]);
        if (hit && trouble == 1)
          TypeParam::set_azimuth(packet.bytes, 1, static_cast<unsigned>(random() % 40'000));
        if (hit && trouble == 2) packet.bytes.resize(random() % 1'300);
        if (hit && trouble == 3)
          TypeParam::set_clock(packet.bytes, packet.stamp_ns + static_cast<std::int64_t>(random()));
        if (hit && trouble == 4) (void)stream.hear(packets[n / 2]);
        if (hit && trouble == 5) continue;
        if (trouble == 6 && n < silent) continue;
        (void)stream.hear(packet);
      }
      if (random() % 4 == 0) this->expect_all_accounted_for(stream);
    }
    this->expect_all_accounted_for(stream);
    EXPECT_GT(stream.frames.size(), 10U);
  }
}

TYPED_TEST(BentStream, OneStrayFromAnotherTimeCostsNothingButItself) {
  const auto packets = this->head.frames(4);
  HeardStream<TypeParam> alone, disturbed;
  alone.hear_all(packets);
  std::uint64_t strays = 0;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    (void)disturbed.hear(packets[n]);
    if (n % 50 != 20) continue;
    Payload stray = packets[(n + packets.size() / 3) % packets.size()];
    stray.stamp_ns = packets[n].stamp_ns;
    this->set_stamp(stray, packets[n].stamp_ns + static_cast<std::int64_t>(n) * 7'000'000'000);
    (void)disturbed.hear(stray);
    ++strays;
  }
  this->expect_all_accounted_for(alone);
  this->expect_all_accounted_for(disturbed);
  EXPECT_EQ(disturbed.rejected(Reject::kClockJump), strays);
  EXPECT_EQ(disturbed.decoder.losses().rejected_total(), strays);
  EXPECT_EQ(disturbed.decoder.losses().clock_jumps, 0U);
  EXPECT_EQ(disturbed.decoder.losses().network_gap_packets, 0U);
  ASSERT_EQ(disturbed.frames.size(), alone.frames.size());
  for (std::size_t n = 0; n < alone.frames.size(); ++n) {
    EXPECT_EQ(disturbed.frames[n].returns, alone.frames[n].returns) << n;
    EXPECT_EQ(disturbed.frames[n].complete, alone.frames[n].complete) << n;
  }
}

TYPED_TEST(BentStream, ARejectedPacketOfAnotherTimeHidesNoLoss) {
  const auto packets = this->head.frames(3);
  HeardStream<TypeParam> stream;
  std::uint64_t lost = 0;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    if (n < 100 || n % 50 != 20 || n + 50 > packets.size()) {
      (void)stream.hear(packets[n]);
      continue;
    }
    Payload damaged = packets[n];  // said long after the packet that is lost in its place
    TypeParam::set_azimuth(damaged.bytes, 0, 40'000);
    this->set_stamp(damaged, damaged.stamp_ns + 700'000'000);
    EXPECT_EQ(stream.hear(damaged), Reject::kAzimuthOutOfRange);
    ++lost;
  }
  stream.flush();
  EXPECT_GT(lost, 5U);
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost);
}

TYPED_TEST(BentStream, PacketsAheadOfTheirTimeDoNotEndTheFrame) {
  const auto packets = this->head.frames(3);
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  std::uint64_t strays = 0;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    (void)stream.hear(packets[n]);
    if (n % 40 != 30 || n + 300 >= packets.size()) continue;
    Payload early = packets[n + 300];  // as it will be said in 50 ms or more
    early.stamp_ns = packets[n].stamp_ns + 10'000;
    (void)stream.hear(early);
    ++strays;
  }
  this->expect_all_accounted_for(stream);
  EXPECT_EQ(stream.rejected(Reject::kClockJump), strays);
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(stream.frames.size(), 4U);
}

TYPED_TEST(BentStream, ARestartLosesNothingAndTakesTheNewPace) {
  auto first = Head<TypeParam>{.spin_hz = 5, .share_of_returns = 1}.frames(1.6);
  auto second = Head<TypeParam>{.spin_hz = 20, .share_of_returns = 1}.frames(2.6);
  for (Payload& packet : second) this->set_stamp(packet, packet.stamp_ns - 400'000'000'000);
  second.erase(second.begin() + 60, second.begin() + 63);
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  stream.hear_all(first);
  const std::uint64_t columns_lost_before = stream.decoder.losses().azimuth_hole_columns;
  stream.hear_all(second);
  this->expect_all_accounted_for(stream);
  const auto losses = stream.decoder.losses();
  EXPECT_EQ(losses.rejected_total(), 0U);
  EXPECT_EQ(losses.clock_jumps, 1U);
  EXPECT_EQ(losses.network_gap_packets, 3U);
  EXPECT_EQ(losses.azimuth_hole_columns - columns_lost_before, 3U * TypeParam::kColumns);
}

TYPED_TEST(BentStream, ARestartOfWhichLittleShowsInAFrameHandsNoHeapOfFramesOver) {
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  stream.hear_all(Head<TypeParam>{.share_of_returns = 1}.frames(1.6));
  const auto second = Head<TypeParam>{.share_of_returns = 1}.frames(20);
  const std::size_t packets_a_frame = second.size() / 20;
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (i % packets_a_frame >= 3) continue;
    Payload packet = second[i];
    this->set_stamp(packet, packet.stamp_ns - 400'000'000'000);
    (void)stream.hear(packet);  // looks at the work of each packet
  }
  this->expect_all_accounted_for(stream);
  EXPECT_EQ(stream.decoder.losses().clock_jumps, 1U);
  EXPECT_GT(stream.rejected(Reject::kClockJump), 20U) << "those of the frames before the last";
  EXPECT_LT(stream.rejected(Reject::kClockJump), 31U);
}

}  // namespace
}  // namespace terracut::test
