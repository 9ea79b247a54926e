// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/frame_records.hpp"

#include <gtest/gtest.h>

namespace terracut::test {
namespace {

TEST(FrameRecordsTest, ThatNobodyTakesAreCountedAndTheOldestStay) {
  memory::FixedMemory memory;
  live::FrameRecords records(memory);
  const auto pass_on = [&](std::uint32_t number) {
    status::FrameRecord record;
    record.info.number = number;
    records.pass_on(record);
  };
  std::uint32_t passed = 0;
  while (records.dropped() < 3) pass_on(passed++);

  status::FrameRecord record;
  for (std::uint32_t number = 0; number + 3 < passed; ++number) {
    ASSERT_TRUE(records.take(record));
    EXPECT_EQ(record.info.number, number);
  }
  EXPECT_FALSE(records.take(record));
  pass_on(passed);
  ASSERT_TRUE(records.take(record));
  EXPECT_EQ(record.info.number, passed);
  EXPECT_EQ(records.dropped(), 3U);
}

}  // namespace
}  // namespace terracut::test
