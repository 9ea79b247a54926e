// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/hdl64e/firing_times.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace terracut::hdl64e {
namespace {

TEST(Hdl64ePacket, IsViewedOnlyAtItsExactSize) {
  const std::vector<std::uint8_t> bytes(1248);
  for (const std::size_t size : {0U, 1U, 512U, 1205U, 1207U, 1248U}) {
    EXPECT_EQ(packet_in(std::span(bytes).first(size)), nullptr);
  }
  EXPECT_NE(packet_in(std::span(bytes).first(1206)), nullptr);
}

TEST(Hdl64ePacket, HasItsFieldsAtTheirOffsetsInLittleEndian) {
  std::vector<std::uint8_t> bytes(1207);
  const auto put = [&](std::size_t at, std::initializer_list<int> values) {
    for (const int value : values) bytes[1 + at++] = static_cast<std::uint8_t>(value);
  };
  put(1100, {0xFF, 0xDD, 0x9F, 0x8C});              // block 11: lower, 359.99 deg
  put(1100 + 4 + 3 * 31, {0x10, 0x27, 0xC8});       // laser 31: 20.000 m, 200
  put(1200, {0xFF, 0xA3, 0x93, 0xD6, 0x57, 0xA1});  // 3 599 999 999 us, 'W', 0xA1
  // One byte off any alignment.
  const auto* read = packet_in(std::span<const std::uint8_t>(bytes).subspan(1));
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->blocks[11].id.value(), kLowerBlockId);
  EXPECT_EQ(read->blocks[11].azimuth_cdeg.value(), 35999);
  EXPECT_EQ(read->blocks[11].returns[31].distance.value(), 10000);
  EXPECT_EQ(read->blocks[11].returns[31].intensity, 200);
  EXPECT_EQ(read->stamp_us.value(), 3'599'999'999U);
  EXPECT_EQ(read->status_type, 'W');
  EXPECT_EQ(read->status_value, 0xA1);
}

TEST(Hdl64ePacket, ReadsBackWhatWasWritten) {
  wire::Packet packet = blank_packet();
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    packet.blocks[block].azimuth_cdeg = static_cast<std::uint16_t>(35'000 + block);
    for (std::size_t laser = 0; laser < kLasersPerBlock; ++laser) {
      auto& beam = packet.blocks[block].returns[laser];
      beam.distance = static_cast<std::uint16_t>(block * 2048 + laser);
      beam.intensity = static_cast<std::uint8_t>(laser);
    }
  }
  packet.stamp_us = 0xD693A3FE;
  packet.status_type = 'T';
  packet.status_value = 41;
  const auto* read = packet_in(payload_of(packet));
  ASSERT_NE(read, nullptr);
  EXPECT_TRUE(is_hdl64e(*read));
  for (std::size_t number = 0; number < read->blocks.size(); ++number) {
    const wire::Block& block = read->blocks[number];
    EXPECT_EQ(block.id.value(), number % 2 == 0 ? kUpperBlockId : kLowerBlockId);
    EXPECT_EQ(block.azimuth_cdeg.value(), 35'000 + number);
    for (std::size_t laser = 0; laser < block.returns.size(); ++laser) {
      EXPECT_EQ(block.returns[laser].distance.value(), number * 2048 + laser);
      EXPECT_EQ(block.returns[laser].intensity, laser);
    }
  }
  EXPECT_EQ(read->stamp_us.value(), 0xD693A3FEU);
  EXPECT_EQ(read->status_type, 'T');
  EXPECT_EQ(read->status_value, 41);
  packet.blocks[1].id = kUpperBlockId;
  EXPECT_FALSE(is_hdl64e(*packet_in(payload_of(packet))));
}

TEST(Hdl64ePacket, FiringTimesFollowTheMakersTables) {
  EXPECT_EQ(kFiringTimesSingle48.laser_ns(0), 0);
  EXPECT_EQ(kFiringTimesSingle48.laser_ns(3), 3'660);
  EXPECT_EQ(kFiringTimesSingle48.laser_ns(31), 45'660);
  EXPECT_EQ(kFiringTimesDual.laser_ns(31), 54'100);
}

TEST(Hdl64ePacket, DeviceStepsGoTheShortWayRoundTheHour) {
  EXPECT_EQ(device_step_us(3'599'999'900, 188), 288);
  EXPECT_EQ(device_step_us(188, 3'599'999'900), -288);
  EXPECT_EQ(device_step_us(0, 1'799'999'999), 1'799'999'999);
  EXPECT_EQ(device_step_us(0, 1'800'000'000), -1'800'000'000);
  EXPECT_EQ(device_step_us(0xFFFFFFFF, 0xFFFFFFFF), 0);
  for (const std::uint32_t absurd : {3'600'000'001U, 0xFFFFFFFFU}) {
    EXPECT_LE(std::abs(device_step_us(0, absurd)), 1'800'000'000);
    EXPECT_LE(std::abs(device_step_us(absurd, 0)), 1'800'000'000);
  }
}

}  // namespace
}  // namespace terracut::hdl64e
