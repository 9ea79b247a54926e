// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/unknown_packets.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware_io/packet/hdl64e_wire.hpp"

namespace terracut::sensor {
namespace {

using testing::HasSubstr;

TEST(GuessOfUnknown, FindsAPacketWithBytesAroundIt) {
  hdl64e::wire::Packet packet{};
  for (auto& block : packet.blocks) block.id = hdl64e::kUpperBlockId;
  packet.status_value = 0x22;
  std::vector<std::uint8_t> payload(8 + hdl64e::kHdl64ePacketBytes + 4);
  std::ranges::copy(hdl64e::payload_of(packet), payload.begin() + 8);
  EXPECT_THAT(guess_of_unknown({.payload = payload, .destination_port = 2368}),
              HasSubstr("packets of a Velodyne VLP-16 with 8 bytes before and 4 behind them"));
}

TEST(GuessOfUnknown, GoesByPortAndBySize) {
  const std::vector<std::uint8_t> ouster(24'896), hesai(1080), anything(777);
  EXPECT_EQ(guess_of_unknown({.payload = anything, .destination_port = 7502}),
            "of Ouster by port?");
  EXPECT_EQ(guess_of_unknown({.payload = ouster, .destination_port = 1}),
            "of Ouster of 128 rows by size?");
  EXPECT_EQ(guess_of_unknown({.payload = hesai, .destination_port = 2368}),
            "of Velodyne or Hesai by port, Hesai PandarXT-32 by size?");
  EXPECT_EQ(guess_of_unknown({.payload = anything, .destination_port = 1}), "");
}

/// A payload that begins with these bytes, the rest 0.
std::vector<std::uint8_t> beginning_with(std::vector<std::uint8_t> bytes, std::size_t size) {
  bytes.resize(size);
  return bytes;
}

TEST(GuessOfUnknown, ReadsTheHeaderOfHesaisOtherModelsAndNamesTheNearest) {
  const auto later = beginning_with({0xEE, 0xFF, 1, 4, 200, 0, 128, 2, 0, 4}, 861);
  EXPECT_EQ(
      guess_of_unknown({.payload = later, .destination_port = 2368}),
      "of a Hesai that is not read: 128 lasers in 2 blocks, protocol 1.4, the size of a "
      "Hesai OT128 or Pandar128's; of as many lasers are read: Hesai PandarQT128 (1095 bytes), "
      "Hesai OT128 (861 bytes), Hesai Pandar128 (861 bytes)");
  const auto at128 = beginning_with({0xEE, 0xFF, 4, 3, 0, 0, 128, 2, 0, 4}, 1118);
  EXPECT_THAT(guess_of_unknown({.payload = at128}), HasSubstr("Hesai AT128"));
  const auto other = beginning_with({0xEE, 0xFF, 9, 9, 0, 0, 7, 3, 0, 4}, 500);
  EXPECT_EQ(guess_of_unknown({.payload = other}),
            "of a Hesai that is not read: 7 lasers in 3 blocks, protocol 9.9");
}

TEST(GuessOfUnknown, ReadsLivoxsHeadersByTheLengthsInThem) {
  auto mid360 = beginning_with({0, 0x64, 0x05, 0, 0, 96, 0, 0, 0, 0, 1}, 1380);
  EXPECT_THAT(guess_of_unknown({.payload = mid360, .destination_port = 1}),
              HasSubstr("Livox (Mid-360 or HAP)"));
  mid360[5] = 95;  // no longer as many points as its length says
  EXPECT_EQ(guess_of_unknown({.payload = mid360, .destination_port = 56'301}),
            "of Livox by port, Livox Mid-360 by size?");
  const auto imu = beginning_with({0, 60, 0, 0, 0, 1, 0, 0, 0, 0, 0}, 60);
  EXPECT_EQ(guess_of_unknown({.payload = imu}), "of a Livox's IMU");
  const auto avia = beginning_with({5, 0, 0, 0, 0, 0, 0, 0, 0, 2}, 18 + 96 * 14);
  EXPECT_THAT(guess_of_unknown({.payload = avia}), HasSubstr("Avia"));
}

TEST(GuessOfUnknown, ReadsRoboSensesHeaders) {
  const auto m1 = beginning_with({0x55, 0xAA, 0x5A, 0xA5}, 1210);
  EXPECT_THAT(guess_of_unknown({.payload = m1}), HasSubstr("RoboSense without rows (M1"));
  const auto rotating = beginning_with({0x55, 0xAA, 0x05, 0x5A}, 1300);
  EXPECT_THAT(guess_of_unknown({.payload = rotating}), HasSubstr("RS-Ruby128"));
}

TEST(GuessOfUnknown, ReadsNothingOutsideAnyPayload) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 200; ++size) {
    for (const std::uint8_t first : std::array<std::uint8_t, 4>{0x00, 0x05, 0x55, 0xEE}) {
      std::vector<std::uint8_t> payload(size);  // its own allocation: a sanitizer sees its end
      for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
      if (size > 0) payload[0] = first;
      if (size > 1 && first == 0xEE) payload[1] = 0xFF;
      (void)guess_of_unknown({.payload = payload});
    }
  }
}

}  // namespace
}  // namespace terracut::sensor
