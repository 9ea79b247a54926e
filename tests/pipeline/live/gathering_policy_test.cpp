// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/gathering_policy.hpp"

#include <gtest/gtest.h>

namespace terracut::live {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

GatheringPolicy policy(std::size_t room_packets = 1'000'000) {
  GatheringPolicy policy({.frame_period_ns = 100 * kMillisecond_ns,
                          .longest_ns = 20 * kMillisecond_ns,
                          .room_packets = room_packets});
  policy.begin(0);
  return policy;
}

TEST(GatheringPolicy, LetsPacketsGatherAsLongAsTold) {
  EXPECT_EQ(policy().time_ns(), 20 * kMillisecond_ns);
}

TEST(GatheringPolicy, LeavesHalfOfTheKernelsBufferFreeInAFlood) {
  GatheringPolicy flooded = policy(1000);
  flooded.note_frame(100 * kMillisecond_ns, 1000);
  flooded.note_frame(200 * kMillisecond_ns, 11'000);
  EXPECT_EQ(flooded.time_ns(), 5 * kMillisecond_ns) << "500 of 10,000 packets a frame";
}

TEST(GatheringPolicy, FollowsAHeadThatRotatesFaster) {
  GatheringPolicy faster = policy(1000);
  faster.note_frame(100 * kMillisecond_ns, 4000);
  faster.note_frame(200 * kMillisecond_ns, 8000);
  EXPECT_EQ(faster.time_ns(), 12'500'000) << "500 of 4,000 packets a frame";
  faster.note_frame(250 * kMillisecond_ns, 12'000);
  EXPECT_EQ(faster.time_ns(), 6'250'000);
}

}  // namespace
}  // namespace terracut::live
