// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/text_lines.hpp"

#include <gtest/gtest.h>

namespace terracut::text {
namespace {

TEST(TextLines, AreTrimmedAtBothEndsAlone) {
  EXPECT_EQ(trimmed(" \t a  b \r"), "a  b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed("a "), "a");
  EXPECT_EQ(trimmed(" \t\r"), "");
}

}  // namespace
}  // namespace terracut::text
