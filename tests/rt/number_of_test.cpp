// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/number_of.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace terracut::rt {
namespace {

TEST(NumberOf, ReadsANumberThatIsTheWholeText) {
  EXPECT_EQ(number_of<int>("-12"), -12);
  EXPECT_EQ(number_of<double>("2.5e1"), 25.0);
  EXPECT_EQ(number_of<std::uint64_t>("18446744073709551615"), UINT64_MAX);
}

TEST(NumberOf, ReadsNothingElse) {
  for (const char* bad : {"", " ", "3m", " 3", "3 ", "+3", "0x10", "1,5", "--1"}) {
    EXPECT_FALSE(number_of<int>(bad)) << bad;
    EXPECT_FALSE(number_of<double>(bad)) << bad;
  }
  EXPECT_FALSE(number_of<int>("2.5"));
}

TEST(NumberOf, ReadsNoNumberThatDoesNotFit) {
  EXPECT_FALSE(number_of<std::uint8_t>("256"));
  EXPECT_FALSE(number_of<std::uint64_t>("-1"));
  EXPECT_FALSE(number_of<double>("1e9999"));
}

}  // namespace
}  // namespace terracut::rt
