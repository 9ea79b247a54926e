// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/eval/report/html.hpp"

#include <gtest/gtest.h>

namespace terracut::evaluation::report {
namespace {

std::string base64_of(std::string_view text) {
  return base64(std::as_bytes(std::span(text)));
}

TEST(Html, EscapesWhatWouldBeMarkup) {
  EXPECT_EQ(escaped(R"(a<b> & "c")"), "a&lt;b&gt; &amp; &quot;c&quot;");
}

TEST(Html, EncodesTheTestVectorsOfRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xFF\xEF\xBE"), "/+++");
}

}  // namespace
}  // namespace terracut::evaluation::report
