// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/memory/fixed_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

namespace terracut::memory {
namespace {

TEST(FixedMemory, GivesZeroedSpansOnCacheLines) {
  FixedMemory memory;
  const auto words = memory.take<std::uint32_t>("words", 1000);
  const auto bytes = memory.take<std::uint8_t>("bytes", 3);
  ASSERT_EQ(words.size(), 1000U);
  EXPECT_TRUE(std::all_of(words.begin(), words.end(), [](std::uint32_t w) { return w == 0; }));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(words.data()) % FixedMemory::kAlignment, 0U);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes.data()) % FixedMemory::kAlignment, 0U);
}

TEST(FixedMemory, AddsUpWhatWasTakenUnderOneName) {
  FixedMemory memory;
  (void)memory.take<float>("planes", 16);  // one cache line
  (void)memory.take<float>("planes", 17);  // two, rounded up
  (void)memory.take<char>("other", 1);
  ASSERT_EQ(memory.parts().size(), 2U);
  EXPECT_EQ(memory.parts()[0].name, "planes");
  EXPECT_EQ(memory.parts()[0].bytes, 3U * 64);
  EXPECT_EQ(memory.total_bytes(), 4U * 64);
}

TEST(FixedMemory, TakesEverythingSideBySideFromTheRegionThatADryRunMeasured) {
  const auto build = [](FixedMemory& memory) {
    return std::array{memory.take<char>("small", 3).data(),
                      memory.take<char>("large", 10'000).data(),
                      memory.take<char>("small", 64).data(), memory.take<char>("none", 0).data()};
  };
  FixedMemory plan;
  (void)build(plan);
  FixedMemory memory;
  ASSERT_TRUE(memory.reserve(plan.total_bytes(), {}).has_value());
  const auto built = build(memory);

  const auto* region = reinterpret_cast<const char*>(memory.region().data());
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(region) % FixedMemory::kAlignment, 0U);
  EXPECT_EQ(built[0], region);
  EXPECT_EQ(built[1], region + 64);
  EXPECT_EQ(built[2], region + 64 + 10'048);
  EXPECT_EQ(memory.region().size(), 64U + 10'048 + 64);
  EXPECT_TRUE(memory.within_plan().has_value());
  ASSERT_EQ(memory.parts().size(), plan.parts().size());
  for (std::size_t n = 0; n < plan.parts().size(); ++n) {
    EXPECT_EQ(memory.parts()[n].name, plan.parts()[n].name);
    EXPECT_EQ(memory.parts()[n].bytes, plan.parts()[n].bytes);
  }
}

TEST(FixedMemory, GivesZeroesFromARegionToo) {
  FixedMemory memory;
  ASSERT_TRUE(memory.reserve(1 << 20, {}).has_value());
  const auto bytes = memory.take<std::uint8_t>("bytes", 1 << 20);
  EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b == 0; }));
}

TEST(FixedMemory, SaysWhichPartExceededThePlanAndHowMuchWouldHaveDone) {
  FixedMemory memory;
  ASSERT_TRUE(memory.reserve(128, {}).has_value());
  (void)memory.take<char>("fits", 64);
  const auto exceeding = memory.take<char>("frames", 65);
  (void)memory.take<char>("later", 1000);
  std::fill(exceeding.begin(), exceeding.end(), 'x');  // it is memory all the same
  const Status status = memory.within_plan();
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::kCapacityExceeded);
  EXPECT_THAT(status.error().message, testing::HasSubstr("'frames'"));
  EXPECT_THAT(status.error().message, testing::HasSubstr("128 bytes were reserved"));
  EXPECT_THAT(status.error().message,
              testing::HasSubstr(std::to_string(memory.total_bytes()) + " were taken"));
  EXPECT_EQ(memory.total_bytes(), 64U + 128 + 1024);
}

TEST(FixedMemory, ReservesOnlyOnceAndOnlyAtTheBeginning) {
  FixedMemory used;
  (void)used.take<char>("early", 1);
  const auto too_late = used.reserve(64, {});
  ASSERT_FALSE(too_late.has_value());
  EXPECT_EQ(too_late.error().code, ErrorCode::kInvalidArgument);
  FixedMemory twice;
  ASSERT_TRUE(twice.reserve(64, {}).has_value());
  EXPECT_FALSE(twice.reserve(64, {}).has_value());
}

}  // namespace
}  // namespace terracut::memory
