// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/number_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

namespace terracut::text {
namespace {

TEST(NumberText, ReadsWholeNumbersOnly) {
  EXPECT_EQ(number_from("12.5"), 12.5);
  EXPECT_EQ(number_from(" \t-3e2\r\n"), -300.0);
  EXPECT_EQ(number_from("+4"), 4.0);
  for (const char* bad :
       {"", " ", "+", "-", "+-4", "++4", "1 2", "3m", "0x10", "1,5", "--1", "e5"}) {
    EXPECT_FALSE(number_from(bad).has_value()) << bad;
  }
}

TEST(NumberText, HandsOnWhatTheTextSaysIsNotFinite) {
  EXPECT_TRUE(std::isnan(number_from("nan").value()));
  EXPECT_TRUE(std::isnan(number_from(".nan").value()));
  EXPECT_TRUE(std::isinf(number_from(".inf").value()));
  EXPECT_TRUE(std::isinf(number_from("-.inf").value()));
  EXPECT_TRUE(std::isinf(number_from("1e9999").value()));
}

TEST(NumberText, ChangesUnitsWithOneRounding) {
  EXPECT_EQ(number_from("123.7", -2), 1.237);
  EXPECT_EQ(number_from("1.237e+02", -2), 1.237);
  EXPECT_EQ(number_from("2.6 ", -2), 0.026);
  EXPECT_FALSE(number_from("12 cm", -2).has_value());
  EXPECT_TRUE(std::isnan(number_from("nan", -2).value()));
}

TEST(NumberText, WritesTextThatReadsBackTheSameBits) {
  EXPECT_EQ(text_of(1.237, -2), "123.7");
  EXPECT_EQ(text_of(0, -2), "0");
  std::mt19937_64 random(8);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value) || std::abs(value) > 1e300 || std::abs(value) < 1e-290) continue;
    for (const int exponent : {-2, 0, 3}) {
      ASSERT_EQ(number_from(text_of(value, exponent), exponent), value) << value;
    }
  }
}

TEST(NumberText, CountsLinesFromOne) {
  EXPECT_EQ(line_of("a\nb\nc", 0), 1);
  EXPECT_EQ(line_of("a\nb\nc", 4), 3);
  EXPECT_EQ(line_of("a\nb\nc", 400), 3);
}

}  // namespace
}  // namespace terracut::text
