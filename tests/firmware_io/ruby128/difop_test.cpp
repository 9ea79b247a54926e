// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/difop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "firmware_io/ruby128/device_info.hpp"

namespace terracut::ruby128 {
namespace {

/// A packet made by offsets alone, as the format's description gives them: every byte of a field
/// tells where it stands.
std::vector<std::uint8_t> packet_by_offsets() {
  std::vector<std::uint8_t> bytes(1248);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + 3);
  const std::uint8_t magic[] = {0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  std::copy(std::begin(magic), std::end(magic), bytes.begin());
  const std::string sentence = "$GPRMC,001225,A,2237.4966,N,11356.1533,E*2B";
  std::copy(sentence.begin(), sentence.end(), bytes.begin() + 382);
  bytes[382 + sentence.size()] = '\r';
  bytes[382 + sentence.size() + 1] = '\n';
  bytes[382 + sentence.size() + 2] = 0;
  return bytes;
}

TEST(Difop, FactsStandAtTheOffsetsOfTheFormat) {
  const std::vector<std::uint8_t> bytes = packet_by_offsets();
  const auto difop = read_difop(bytes);
  ASSERT_TRUE(difop.has_value());
  const Ruby128DeviceInfo info = device_info_of(*difop);
  const auto u16 = [&](std::size_t at) { return bytes[at] * 256 + bytes[at + 1]; };
  const auto at = [&](std::size_t offset, const auto& field) {
    return std::equal(field.begin(), field.end(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  };
  EXPECT_EQ(info.rpm_set, u16(8));
  EXPECT_EQ(info.rpm_actual, u16(373));
  EXPECT_TRUE(at(10, info.device_address));
  EXPECT_TRUE(at(14, info.destination_address));
  EXPECT_TRUE(at(18, info.mac));
  EXPECT_EQ(info.data_port, u16(24));
  EXPECT_EQ(info.device_port, u16(28));
  EXPECT_EQ(info.fov_start_cdeg, u16(32));
  EXPECT_EQ(info.fov_end_cdeg, u16(34));
  EXPECT_EQ(info.phase_lock_raw, u16(38));
  EXPECT_TRUE(at(40, info.top_firmware));
  EXPECT_TRUE(at(45, info.bottom_firmware));
  EXPECT_TRUE(at(50, info.bottom_software));
  EXPECT_TRUE(at(55, info.motor_firmware));
  EXPECT_TRUE(at(60, info.hardware));
  EXPECT_TRUE(at(292, info.serial));
  EXPECT_EQ(info.zero_angle_raw, u16(298));
  EXPECT_EQ(info.return_mode_raw, bytes[300]);
  EXPECT_EQ(info.sync_mode_raw, bytes[301]);
  EXPECT_EQ(info.sync_status_raw, bytes[302]);
  EXPECT_TRUE(at(303, info.stamp));
  EXPECT_EQ(info.gps_status_raw, bytes[357]);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(info.temperatures_raw[i], u16(358 + 2 * i));
  EXPECT_EQ(info.gprmc, "$GPRMC,001225,A,2237.4966,N,11356.1533,E*2B");
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
  EXPECT_FALSE(is_difop(Ruby128PacketBuffer().payload()));
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

TEST(Difop, FactsSurviveWritingAndReading) {
  const auto read = read_difop(packet_by_offsets());
  const Ruby128DeviceInfo info = device_info_of(*read);
  ruby128_wire::Difop written = blank_difop();
  set_device_info(written, info);
  EXPECT_EQ(device_info_of(*read_difop(payload_of(written))), info);
}

TEST(Difop, ALongerSentenceOverwrittenByAShorterLeavesNothing) {
  ruby128_wire::Difop difop = blank_difop();
  Ruby128DeviceInfo info;
  info.gprmc = std::string(100, 'x');
  set_device_info(difop, info);
  EXPECT_EQ(device_info_of(difop).gprmc, std::string(86, 'x'));
  info.gprmc = "$GPRMC";
  set_device_info(difop, info);
  EXPECT_EQ(device_info_of(difop).gprmc, "$GPRMC");
}

TEST(Difop, SentencesAreSafeToPrint) {
  ruby128_wire::Difop difop = blank_difop();
  const auto shown = [&](const std::string& sent) {
    difop.gprmc = {};
    std::copy(sent.begin(), sent.end(), difop.gprmc.begin());
    return device_info_of(difop).gprmc;
  };
  EXPECT_EQ(shown("$GP\x1b[31m\r\nerror: none\xC3\xA4\t \r\n"), "$GP?[31m??error: none???");
  EXPECT_EQ(shown(std::string(86, '\xFF')), "");
  EXPECT_EQ(shown(std::string("\0$GP", 4)), "");
  EXPECT_EQ(shown(""), "");
}

TEST(Difop, FactsAsText) {
  EXPECT_EQ(address_text({192, 168, 1, 200}), "192.168.1.200");
  const std::uint8_t mac[] = {0x00, 0x1C, 0x23, 0x17, 0x4A, 0xCC};
  EXPECT_EQ(hex_text(mac, ":"), "00:1c:23:17:4a:cc");
  EXPECT_EQ(hex_text(mac), "001c23174acc");
  EXPECT_EQ(hex_text({}), "");
  EXPECT_EQ(sync_mode_name(0), "GPS");
  EXPECT_EQ(sync_mode_name(3), "gPTP");
  EXPECT_EQ(sync_mode_name(4), "unknown");
}

}  // namespace
}  // namespace terracut::ruby128
