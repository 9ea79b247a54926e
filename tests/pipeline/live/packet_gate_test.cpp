// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/packet_gate.hpp"

#include <gtest/gtest.h>

namespace terracut::live {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kNow_ns = 1'700'000'000'000 * kMs;

class PacketGateOf50Ms : public testing::Test {
 protected:
  void hand_over_frame_aged(std::int64_t age_ns) { gate_.note_frame(kNow_ns - age_ns, kNow_ns); }
  [[nodiscard]] bool lets_in_packet_aged(std::int64_t age_ns) {
    return gate_.lets_in(kNow_ns - age_ns, kNow_ns);
  }

  PacketGate gate_{50 * kMs, 100 * kMs};
};

TEST_F(PacketGateOf50Ms, LetsAPacketGoOnlyWhenItsFrameIsDueWhateverIsDone) {
  EXPECT_TRUE(lets_in_packet_aged(0));
  EXPECT_TRUE(lets_in_packet_aged(150 * kMs));
  EXPECT_FALSE(lets_in_packet_aged(150 * kMs + 1));
  EXPECT_TRUE(lets_in_packet_aged(149 * kMs)) << "the next one";
  EXPECT_TRUE(lets_in_packet_aged(-3'600'000 * kMs)) << "the clock was set back";
}

TEST_F(PacketGateOf50Ms, LetsTheBacklogGoAfterThreeLateFramesInARow) {
  gate_.begin_batch(true);
  hand_over_frame_aged(51 * kMs);
  hand_over_frame_aged(60 * kMs);
  EXPECT_TRUE(lets_in_packet_aged(40 * kMs)) << "it may be catching up";
  hand_over_frame_aged(70 * kMs);
  EXPECT_FALSE(lets_in_packet_aged(40 * kMs));
  gate_.begin_batch(true);
  EXPECT_FALSE(lets_in_packet_aged(1 * kMs)) << "more may wait";
  gate_.begin_batch(false);
  EXPECT_TRUE(lets_in_packet_aged(1 * kMs)) << "these are the newest";
  gate_.begin_batch(true);
  EXPECT_TRUE(lets_in_packet_aged(1 * kMs)) << "and it goes on with them";
}

TEST_F(PacketGateOf50Ms, CountsLateFramesInARowOnly) {
  for (int i = 0; i < 10; ++i) {
    hand_over_frame_aged(60 * kMs);
    hand_over_frame_aged(60 * kMs);
    hand_over_frame_aged(50 * kMs);
  }
  EXPECT_TRUE(lets_in_packet_aged(0));
}

}  // namespace
}  // namespace terracut::live
