// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/stolen_time.hpp"

#include <gtest/gtest.h>

namespace terracut::measure {
namespace {

TEST(StolenTime, IsTheEighthNumberOfTheLineForAllCores) {
  constexpr auto kText =
      "cpu  257417 0 33449 375189 909 0 167 90 0 0\ncpu0 1 2 3 4 5 6 7 45 9 10\n";
  EXPECT_EQ(StolenTime::parse_ns(kText, 100), 900'000'000);
  EXPECT_EQ(StolenTime::parse_ns(kText, 1000), 90'000'000);
}

TEST(StolenTime, IsUnknownWhereTheTextIsAnother) {
  EXPECT_EQ(StolenTime::parse_ns("", 100), std::nullopt);
  EXPECT_EQ(StolenTime::parse_ns("cpu0 1 2 3 4 5 6 7 8 9 10", 100), std::nullopt);
  EXPECT_EQ(StolenTime::parse_ns("cpu  1 2 3 4 5 6 7\n8", 100), std::nullopt) << "too old a kernel";
}

TEST(StolenTime, NeverRunsBackwards) {
  const auto stolen = StolenTime::open();
  if (!stolen) GTEST_SKIP() << stolen.error().message;
  const auto first = stolen->read_ns();
  const auto second = stolen->read_ns();
  ASSERT_TRUE(first && second);
  EXPECT_GE(*first, 0);
  EXPECT_GE(*second, *first);
}

}  // namespace
}  // namespace terracut::measure
