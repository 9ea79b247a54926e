// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/transpose.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace terracut::frame {
namespace {

template <class Value>
void expect_transposed() {
  constexpr std::size_t kRows = 24, kColumns = 64;
  std::vector<Value> from(kRows * kColumns), to(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<Value>(i * 3);
  transpose(from.data(), kRows, kColumns, to.data());
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      ASSERT_EQ(to[column * kRows + row], from[row * kColumns + column]) << row << ' ' << column;
    }
  }
}

TEST(Transpose, RowsBecomeColumns) {
  expect_transposed<std::uint16_t>();
  expect_transposed<std::uint8_t>();
}

}  // namespace
}  // namespace terracut::frame
