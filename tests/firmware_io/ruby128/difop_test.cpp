// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/difop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace terracut::ruby128 {
namespace {

/// A packet made by offsets alone, as the format's description gives them: every byte of a field
/// tells where it stands.
std::vector<std::uint8_t> packet_by_offsets() {
  std::vector<std::uint8_t> bytes(1248);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + 3);
  const std::uint8_t magic[] = {0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  std::copy(std::begin(magic), std::end(magic), bytes.begin());
  return bytes;
}

TEST(Difop, FactsStandAtTheOffsetsOfTheFormat) {
  const std::vector<std::uint8_t> bytes = packet_by_offsets();
  const auto difop = read_difop(bytes);
  ASSERT_TRUE(difop.has_value());
  const auto u16 = [&](std::size_t at) { return bytes[at] * 256 + bytes[at + 1]; };
  const auto at = [&](std::size_t offset, const auto& field) {
    return std::equal(field.begin(), field.end(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  };
  EXPECT_EQ(difop->rpm_set.value(), u16(8));
  EXPECT_EQ(difop->rpm_actual.value(), u16(373));
  EXPECT_TRUE(at(10, difop->device_address));
  EXPECT_TRUE(at(14, difop->destination_address));
  EXPECT_TRUE(at(18, difop->mac));
  EXPECT_EQ(difop->data_port.value(), u16(24));
  EXPECT_EQ(difop->device_port.value(), u16(28));
  EXPECT_TRUE(at(292, difop->serial));
  EXPECT_EQ(difop->return_mode, bytes[300]);
  EXPECT_EQ(difop->sync_mode, bytes[301]);
  EXPECT_EQ(difop->sync_status, bytes[302]);
  EXPECT_TRUE(at(303, difop->stamp));
}

TEST(Difop, IsKnownByItsLengthAndItsFirstEightBytes) {
  std::vector<std::uint8_t> bytes = packet_by_offsets();
  EXPECT_TRUE(is_difop(bytes));
  for (std::size_t i = 0; i < 8; ++i) {
    bytes[i] ^= 1;
    EXPECT_FALSE(is_difop(bytes)) << i;
    bytes[i] ^= 1;
  }
  bytes.push_back(0);
  EXPECT_FALSE(is_difop(bytes));
  bytes.resize(1247);
  EXPECT_FALSE(is_difop(bytes));
  EXPECT_FALSE(is_difop({}));
  EXPECT_FALSE(read_difop({}).has_value());
}

TEST(Difop, DataPacketsAreNone) {
  const auto data = blank_packet();
  EXPECT_FALSE(is_difop(payload_of(data)));
}

TEST(Difop, ABlankOneHasMagicTailAndUnsetAngles) {
  const ruby128_wire::Difop blank = blank_difop();
  const auto payload = payload_of(blank);
  EXPECT_TRUE(is_difop(payload));
  EXPECT_EQ(payload[1246], 0x0F);
  EXPECT_EQ(payload[1247], 0xF0);
  for (std::size_t i = 8; i < 1246; ++i) {
    EXPECT_EQ(payload[i], i >= 468 && i < 1236 ? 0xFF : 0) << i;
  }
}

TEST(Difop, SyncModesHaveNames) {
  EXPECT_EQ(sync_mode_name(0), "GPS");
  EXPECT_EQ(sync_mode_name(3), "gPTP");
  EXPECT_EQ(sync_mode_name(4), "unknown");
}

}  // namespace
}  // namespace terracut::ruby128
