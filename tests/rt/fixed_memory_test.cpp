// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/fixed_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace terracut::rt {
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

}  // namespace
}  // namespace terracut::rt
