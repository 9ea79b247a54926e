// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/sensor_recognition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/robosense_wire.hpp"
#include "tests/firmware_io/capture/capture_bytes.hpp"

namespace terracut::sensor {
namespace {

using test::Bytes;
using testing::HasSubstr;

/// A Velodyne data packet with the given block ids, repeated, and last two bytes.
Bytes velodyne(std::initializer_list<std::uint16_t> ids, std::uint8_t mode, std::uint8_t product) {
  hdl64e::wire::Packet packet{};
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    packet.blocks[block].id = ids.begin()[block % ids.size()];
  }
  packet.status_type = mode;
  packet.status_value = product;
  const auto payload = hdl64e::payload_of(packet);
  return {payload.begin(), payload.end()};
}

Bytes robosense(std::initializer_list<int> start, std::size_t block_bytes) {
  Bytes payload(1248, 0);
  std::transform(start.begin(), start.end(), payload.begin(),
                 [](int byte) { return static_cast<std::uint8_t>(byte); });
  if (block_bytes != 0) {
    for (std::size_t at = 80; at + block_bytes <= 1248; at += block_bytes) payload[at] = 0xFE;
  }
  return payload;
}

TEST(SensorRecognition, KnowsAnHdl64eWhateverItsStatusBytesAre) {
  for (int product = 0; product < 256; ++product) {
    const Bytes payload = velodyne({0xEEFF, 0xDDFF}, 0x37, static_cast<std::uint8_t>(product));
    ASSERT_EQ(recognise_sensor(payload), SensorModel::kHdl64e) << product;
  }
}

TEST(SensorRecognition, TellsTheOtherVelodynesApart) {
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF}, 0x37, 0x21)), SensorModel::kHdl32e);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF}, 0x37, 0x22)), SensorModel::kVlp16);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF}, 0x37, 0x24)), SensorModel::kVlp16HiRes);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF}, 0x37, 0x28)), SensorModel::kVlp32c);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF}, 0x37, 0x77)), SensorModel::kOtherVelodyne);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF}, 0x37, 0xA1)),
            SensorModel::kVls128);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF, 0xEEFF, 0xDDFF, 0xDDFF, 0xCCFF, 0xCCFF, 0xBBFF,
                                       0xBBFF, 0x0000, 0x0000, 0x0000, 0x0000},
                                      0x39, 0xA1)),
            SensorModel::kVls128);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF, 0xEEFF, 0xEEFF, 0xDDFF}, 0x37, 0x00)),
            SensorModel::kHdl64eS1);
  // Ids that are in the right place for a VLS-128 once, in single return, or in dual.
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF, 0xEEFF, 0xDDFF, 0xBBFF}, 0x39, 0xA1)),
            SensorModel::kUnknown);
  EXPECT_EQ(recognise_sensor(velodyne({0xEEFF, 0xDDFF, 0xBBFF, 0xBBFF}, 0x37, 0xA1)),
            SensorModel::kUnknown);
  EXPECT_EQ(recognise_sensor(Bytes(1206, 0)), SensorModel::kUnknown);
  for (const auto& [mode, name] : {std::pair(0x37, "strongest return"),
                                   {0x38, "last return"},
                                   {0x39, "dual return"},
                                   {0x3A, "dual return with confidence"},
                                   {0x3B, "return mode not known"}}) {
    EXPECT_THAT(describe_sensor_hints(velodyne({0xEEFF}, static_cast<std::uint8_t>(mode), 0x22)),
                HasSubstr(name));
  }
}

TEST(SensorRecognition, KnowsPositionPackets) {
  Bytes payload(512, 0);
  EXPECT_EQ(recognise_sensor(payload), SensorModel::kVelodynePosition);
  payload[206] = '$';
  EXPECT_EQ(recognise_sensor(payload), SensorModel::kVelodynePosition);
  payload[206] = 0x80;
  EXPECT_EQ(recognise_sensor(payload), SensorModel::kUnknown);
}

TEST(SensorRecognition, NamesTheRubyFamilyByItsBlocks) {
  EXPECT_EQ(recognise_sensor(robosense({0x55, 0xAA, 0x05, 0x5A}, 388)), SensorModel::kRuby128);
  EXPECT_EQ(recognise_sensor(robosense({0x55, 0xAA, 0x05, 0x5A}, 244)), SensorModel::kRubyLite);
  EXPECT_EQ(recognise_sensor(robosense({0x55, 0xAA, 0x05, 0x5A}, 0)), SensorModel::kOtherRoboSense);
  EXPECT_EQ(recognise_sensor(robosense({0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5}, 0)),
            SensorModel::kOtherRoboSense);
  EXPECT_EQ(recognise_sensor(robosense({0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55}, 0)),
            SensorModel::kRoboSenseDeviceInfo);
  EXPECT_EQ(recognise_sensor(robosense({0x55, 0xAA, 0x05}, 388)), SensorModel::kUnknown);
  for (const std::size_t bytes : {388U, 244U}) {
    Bytes cut = robosense({0x55, 0xAA, 0x05, 0x5A}, bytes);
    cut[80 + 2 * bytes] = 0;
    EXPECT_EQ(recognise_sensor(cut), SensorModel::kOtherRoboSense) << bytes;
  }

  Bytes plus = robosense({0x55, 0xAA, 0x05, 0x5A}, 388);
  plus[31] = 5;
  plus[32] = 1;
  EXPECT_EQ(recognise_sensor(plus), SensorModel::kRubyPlus);
  EXPECT_THAT(describe_sensor_hints(plus), HasSubstr("Ruby Plus"));
  for (const auto& [model, name] : {std::pair(2, "Ruby 80"), {3, "Ruby 80V"}, {4, "Ruby 48V"}}) {
    plus[32] = static_cast<std::uint8_t>(model);
    EXPECT_EQ(recognise_sensor(plus), SensorModel::kRuby128);
    EXPECT_THAT(describe_sensor_hints(plus), HasSubstr(name));
  }
  plus[32] = 1;
  plus[7] = 3;
  EXPECT_THAT(describe_sensor_hints(plus), HasSubstr("dual return"));
}

TEST(SensorRecognition, NamesOtherRoboSensesByTheirBlocks) {
  const auto of_blocks = [](std::vector<std::uint8_t> start, std::size_t blocks,
                            std::size_t bytes) {
    Bytes payload(1248);
    std::ranges::copy(start, payload.begin());
    for (std::size_t block = 0; block < blocks; ++block) {
      payload[42 + block * bytes] = 0xFF;
      payload[43 + block * bytes] = 0xEE;
    }
    return payload;
  };
  const auto helios = of_blocks({0x55, 0xAA, 0x05, 0x5A}, 12, 100);
  EXPECT_EQ(recognise_sensor(helios), SensorModel::kOtherRoboSense);
  EXPECT_THAT(describe_sensor_hints(helios), HasSubstr("Helios"));
  EXPECT_THAT(describe_sensor_hints(of_blocks({0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5}, 12, 100)),
              HasSubstr("RS-16's, RS-32's or Bpearl's"));
  EXPECT_THAT(describe_sensor_hints(of_blocks({0x55, 0xAA, 0x05, 0x5A}, 8, 148)),
              HasSubstr("Airy"));
}

TEST(SensorRecognition, TellsARoboSenseOf32LasersByItsTypeOrTheName) {
  for (const auto& layout : robosense::kLayouts) {
    Bytes payload(robosense::kPacketBytes);
    robosense::begin_packet(layout, payload);
    EXPECT_EQ(recognise_sensor(payload), layout.model);
    EXPECT_THAT(describe_sensor_hints(payload), HasSubstr("type bytes 00 "));
    std::swap(payload[30], payload[31]);  // where older manuals have it
    EXPECT_EQ(recognise_sensor(payload), layout.model);
    payload[30] = 0;
    EXPECT_EQ(recognise_sensor(payload), SensorModel::kOtherRoboSense);
    EXPECT_EQ(recognise_sensor_as(layout.model, payload), layout.model);
    EXPECT_EQ(recognise_sensor_as(SensorModel::kRuby128, payload), SensorModel::kOtherRoboSense);
    payload[31] = 6;
    payload[32] = 3;  // a Helios-16P, whose blocks are two firings
    EXPECT_EQ(recognise_sensor(payload), SensorModel::kOtherRoboSense);
    EXPECT_EQ(recognise_sensor_as(layout.model, payload), SensorModel::kOtherRoboSense);
    payload[31] = 0;
    payload[42 + 100 * 11] = 0;
    EXPECT_EQ(recognise_sensor_as(layout.model, payload), SensorModel::kOtherRoboSense);
  }
}

TEST(SensorRecognition, ReadsNothingOutsideAnyPayload) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 1600; ++size) {
    Bytes payload(size);  // its own allocation, so that a sanitizer sees any byte too many
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
    if (size != 1206 && size != 1248 && size != 512) {
      EXPECT_EQ(recognise_sensor(payload), SensorModel::kUnknown);
    }
    EXPECT_TRUE(describe_sensor_hints(payload).empty() || size == 1206 || size == 1248);
  }
}

TEST(SensorRecognition, BelievesTheNamedModelWhereTheProductIsNotKnown) {
  const auto other = velodyne({0xEEFF}, 0x00, 0x00);
  EXPECT_EQ(recognise_sensor_as({}, other), SensorModel::kOtherVelodyne);
  EXPECT_EQ(recognise_sensor_as(SensorModel::kVlp16, other), SensorModel::kVlp16);
  EXPECT_EQ(recognise_sensor_as(SensorModel::kVls128, other), SensorModel::kOtherVelodyne);
  EXPECT_EQ(recognise_sensor_as(SensorModel::kHdl64e, other), SensorModel::kOtherVelodyne);
  const auto hdl32e = velodyne({0xEEFF}, 0x37, 0x21);
  EXPECT_EQ(recognise_sensor_as(SensorModel::kVlp16, hdl32e), SensorModel::kHdl32e);
}

TEST(SensorRecognition, TellsAnOt128FromAPandar128ByTheVersionOrTheName) {
  Bytes payload(861);
  std::ranges::copy(Bytes{0xEE, 0xFF, 1, 4, 0, 0, 128, 2, 0, 4}, payload.begin());
  for (const auto& [version, model] : {std::pair(0, SensorModel::kPandar128),
                                       {127, SensorModel::kPandar128},
                                       {128, SensorModel::kOt128},
                                       {136, SensorModel::kOt128},
                                       {137, SensorModel::kUnknown}}) {
    payload[4] = static_cast<std::uint8_t>(version);
    EXPECT_EQ(recognise_sensor(payload), model) << version;
    EXPECT_EQ(recognise_sensor_as(SensorModel::kOt128, payload), SensorModel::kOt128) << version;
    EXPECT_EQ(recognise_sensor_as(SensorModel::kPandar128, payload), SensorModel::kPandar128)
        << version;
    EXPECT_EQ(recognise_sensor_as(SensorModel::kPandarQt128, payload), model) << version;
  }
}

}  // namespace
}  // namespace terracut::sensor
