// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/wire_returns.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace terracut::packet {
namespace {

/// Bytes that tell where they were.
std::vector<std::uint8_t> counted(std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + 1);
  return bytes;
}

TEST(WireReturns, AreTakenApartInEitherByteOrder) {
  const auto bytes = counted(32 * kWireReturnBytes);
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    std::array<std::uint16_t, 32> raw{};
    std::array<std::uint8_t, 32> intensity{};
    split_returns(bytes.data(), order, raw, intensity.data());
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const unsigned first = bytes[3 * i], second = bytes[3 * i + 1];
      EXPECT_EQ(raw[i], order == ByteOrder::kLittle ? first | second << 8 : first << 8 | second);
      EXPECT_EQ(intensity[i], bytes[3 * i + 2]);
    }
  }
}

}  // namespace
}  // namespace terracut::packet
