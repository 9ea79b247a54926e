// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/pass_stamps.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace terracut::test {
namespace {

using testing::ElementsAre;

/// A pass over packets with these stamps.
std::vector<std::int64_t> play(send::PassStamps& stamps, std::vector<std::int64_t> pass_ns) {
  for (std::int64_t& stamp_ns : pass_ns) stamp_ns = stamps.place(stamp_ns);
  return pass_ns;
}

TEST(PassStamps, LeavesTheFirstPassAsItWasRecorded) {
  send::PassStamps stamps;
  EXPECT_THAT(play(stamps, {100, 110, 120}), ElementsAre(100, 110, 120));
  EXPECT_EQ(stamps.packets(), 3);
}

TEST(PassStamps, GoesOnInEveryFurtherPassAfterAnAveragePause) {
  send::PassStamps stamps;
  play(stamps, {100, 110, 120});
  stamps.next_pass();
  EXPECT_THAT(play(stamps, {100, 110, 120}), ElementsAre(130, 140, 150));
  stamps.next_pass();
  EXPECT_THAT(play(stamps, {100, 110, 120}), ElementsAre(160, 170, 180));
}

TEST(PassStamps, CountsFromTheLatestStampWhereTheLastPacketIsOutOfOrder) {
  send::PassStamps stamps;
  play(stamps, {100, 120, 110});
  stamps.next_pass();
  EXPECT_EQ(stamps.place(100), 130);
}

TEST(PassStamps, StandsStillInACaptureOfOnePacket) {
  send::PassStamps stamps;
  play(stamps, {100});
  stamps.next_pass();
  EXPECT_EQ(stamps.packets(), 0);
  EXPECT_EQ(stamps.place(100), 100);
}

}  // namespace
}  // namespace terracut::test
