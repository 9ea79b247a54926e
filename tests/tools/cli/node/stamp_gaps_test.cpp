// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/node/stamp_gaps.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace terracut::cli {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000, kBegin_ns = 1'700'000'000'000'000'000;

/// Of clouds with these numbers, each a period after the one before, give or take 5 ms.
std::uint64_t missing_of(const std::vector<int>& numbers) {
  StampGaps gaps;
  std::uint64_t missing = 0;
  for (const int number : numbers) {
    const std::int64_t jitter_ns = (number % 3 - 1) * 5'000'000;
    missing += gaps.missing_before(kBegin_ns + number * kPeriod_ns + jitter_ns);
  }
  return missing;
}

TEST(StampGaps, AreNoneWhereEveryCloudCame) {
  EXPECT_EQ(missing_of({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}), 0U);
}

TEST(StampGaps, CountEveryCloudThatDidNotCome) {
  EXPECT_EQ(missing_of({0, 1, 2, 3, 4, 6, 7, 8, 12, 13}), 4U);
}

TEST(StampGaps, CountThoseOfAStreamThatLosesMostOfItsClouds) {
  EXPECT_EQ(missing_of({0, 1, 2, 3, 4, 6, 8, 10, 11, 13, 15, 16, 18, 20, 22}), 8U);
}

TEST(StampGaps, AreNotASilenceOrARecordingThatBeginsAgain) {
  EXPECT_EQ(missing_of({0, 1, 2, 3, 4, 5, 20, 21, 22, 0, 1, 2}), 0U);
}

TEST(StampGaps, AreNotThereWithoutStamps) {
  StampGaps gaps;
  for (int n = 0; n < 20; ++n) EXPECT_EQ(gaps.missing_before(0), 0U);
}

TEST(StampGaps, BeginAnewWhenToldTo) {
  StampGaps gaps;
  for (int n = 0; n < 8; ++n) EXPECT_EQ(gaps.missing_before(kBegin_ns + n * kPeriod_ns), 0U);
  gaps.restart();
  EXPECT_EQ(gaps.missing_before(kBegin_ns + 10 * kPeriod_ns), 0U);
}

}  // namespace
}  // namespace terracut::cli
