// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/drop_counter.hpp"

#include <gtest/gtest.h>

namespace terracut::test {
namespace {

TEST(DropCounter, CountsWhatWasAddedSinceTheLastReading) {
  net::DropCounter drops;
  EXPECT_EQ(drops.advance_to(0), 0U);
  EXPECT_EQ(drops.advance_to(7), 7U);
  EXPECT_EQ(drops.advance_to(7), 0U);
  EXPECT_EQ(drops.advance_to(10), 3U);
}

TEST(DropCounter, GoesOnExactlyWhenTheKernelsCountWraps) {
  net::DropCounter drops;
  std::uint64_t total = 0;
  // Steps below 2^31, to just under the wrap and across it.
  for (const std::uint32_t reading : {0x7FFFFFFFU, 0xFFFFFFFEU, 0xFFFFFFFFU, 0U, 1U, 5U}) {
    total += drops.advance_to(reading);
  }
  EXPECT_EQ(total, (std::uint64_t{1} << 32) + 5);
}

TEST(DropCounter, TakesNoNoticeOfAReadingThatLagsBehind) {
  net::DropCounter drops;
  EXPECT_EQ(drops.advance_to(100), 100U);
  EXPECT_EQ(drops.advance_to(40), 0U);
  EXPECT_EQ(drops.advance_to(101), 1U);
}

TEST(DropCounter, StartsAgainWithANewSocket) {
  net::DropCounter drops;
  EXPECT_EQ(drops.advance_to(100), 100U);
  drops.restart();
  EXPECT_EQ(drops.advance_to(3), 3U);
}

}  // namespace
}  // namespace terracut::test
