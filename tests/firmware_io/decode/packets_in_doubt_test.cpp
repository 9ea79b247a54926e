// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/packets_in_doubt.hpp"

#include <gtest/gtest.h>

#include <array>

namespace terracut::decode {
namespace {

class PacketsInDoubtTest : public testing::Test {
 protected:
  /// `number` in every byte and in the stamps.
  void keep(std::uint8_t number, std::int64_t rotor_cdeg, frame::Reject reason) {
    std::array<std::uint8_t, kBytes> payload;
    payload.fill(number);
    packet::PacketAzimuths azimuths;
    azimuths.device_stamp_us = number;
    Placement placed{.arrival = Arrival::kDoubtful, .reject = reason, .rotor_cdeg = rotor_cdeg};
    in_doubt_.keep({.payload = payload, .stamp_ns = number}, azimuths, placed);
  }

  static constexpr std::size_t kBytes = 4;
  memory::FixedMemory memory_;
  PacketsInDoubt in_doubt_{kBytes, memory_};
};

TEST_F(PacketsInDoubtTest, AreHandedOutOldestFirstWithTheirBytesAndThenForgotten) {
  keep(1, 0, frame::Reject::kClockJump);
  keep(2, 100, frame::Reject::kClockJump);
  EXPECT_EQ(in_doubt_.size(), 2U);
  for (const std::uint8_t number : {std::uint8_t{1}, std::uint8_t{2}}) {
    const PacketsInDoubt::Packet* packet = in_doubt_.take();
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->stamp_ns, number);
    EXPECT_EQ(packet->azimuths.device_stamp_us, number);
    ASSERT_EQ(packet->payload.size(), kBytes);
    for (const std::uint8_t byte : packet->payload) EXPECT_EQ(byte, number);
  }
  EXPECT_EQ(in_doubt_.take(), nullptr);
  EXPECT_EQ(in_doubt_.size(), 0U);
}

TEST_F(PacketsInDoubtTest, CountAsStraysEachForItsOwnReason) {
  keep(1, 0, frame::Reject::kClockJump);
  keep(2, 0, frame::Reject::kAzimuthJump);
  frame::LossCounters losses;
  in_doubt_.drop(losses);
  EXPECT_EQ(in_doubt_.size(), 0U);
  EXPECT_EQ(losses.rejected[static_cast<std::size_t>(frame::Reject::kClockJump)], 1U);
  EXPECT_EQ(losses.rejected[static_cast<std::size_t>(frame::Reject::kAzimuthJump)], 1U);
  EXPECT_EQ(losses.rejected_total(), 2U);
}

TEST_F(PacketsInDoubtTest, AreTooOldMoreThanAFrameBeforeTheNewest) {
  keep(1, 999, frame::Reject::kClockJump);
  keep(2, 1'000, frame::Reject::kClockJump);
  keep(3, 37'000, frame::Reject::kClockJump);
  EXPECT_TRUE(in_doubt_.is_too_old(*in_doubt_.take()));
  EXPECT_FALSE(in_doubt_.is_too_old(*in_doubt_.take()));
  EXPECT_FALSE(in_doubt_.is_too_old(*in_doubt_.take()));
}

TEST_F(PacketsInDoubtTest, HaveRoomForAsManyAsMakeAStream) {
  for (int n = 0; n < StreamTracker::kNewStream_packets; ++n) {
    keep(static_cast<std::uint8_t>(n), n, frame::Reject::kClockJump);
  }
  int taken = 0;
  while (in_doubt_.take() != nullptr) ++taken;
  EXPECT_EQ(taken, StreamTracker::kNewStream_packets);
}

}  // namespace
}  // namespace terracut::decode
