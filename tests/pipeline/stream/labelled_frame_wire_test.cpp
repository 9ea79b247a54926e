// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/labelled_frame_wire.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

namespace terracut::stream {
namespace {

using HeaderBytes = std::array<std::uint8_t, sizeof(FrameWireHeader)>;

FrameWireHeader some_header() {
  return {.number = 0x01020304,
          .points = 3,
          .first_packet_ns = 0x1112131415161718,
          .last_packet_ns = 0x2122232425262728,
          .labels_ns = 0x3132333435363738,
          .sensor = 2,
          .level = 1,
          .flags = kFrameComplete | kFrameLate,
          .missed = 0x41424344,
          .first_return = 0x51525354};
}

TEST(LabelledFrameWire, HeaderHasTheDocumentedBytes) {
  const HeaderBytes expected{
      'T',  'C',  'L',  'T',  1,    0,    56,   0,     // magic, version, header size
      0x04, 0x03, 0x02, 0x01, 3,    0,    0,    0,     // frame, points
      0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11,  // first packet
      0x28, 0x27, 0x26, 0x25, 0x24, 0x23, 0x22, 0x21,  // last packet
      0x38, 0x37, 0x36, 0x35, 0x34, 0x33, 0x32, 0x31,  // labels
      20,   0,    2,    1,    3,    0,    0,    0,     // point size, sensor, level, flags
      0x44, 0x43, 0x42, 0x41, 0x54, 0x53, 0x52, 0x51,  // missed, first return
  };
  EXPECT_EQ(std::bit_cast<HeaderBytes>(some_header()), expected);
}

TEST(LabelledFrameWire, PointHasTheDocumentedBytes) {
  const WirePoint point{1.0F, -2.0F, 0.5F, 200, 99, 0x0102, 0.0625F};
  const std::array<std::uint8_t, 20> expected{0, 0,    0x80, 0x3F, 0,    0,    0, 0xC0, 0,    0,
                                              0, 0x3F, 200,  99,   0x02, 0x01, 0, 0,    0x80, 0x3D};
  EXPECT_EQ((std::bit_cast<std::array<std::uint8_t, 20>>(point)), expected);
}

TEST(LabelledFrameWire, ASectorSaysWhichPieceOfItsFrameItIs) {
  const points::SectorRecord sector{.frame = 7,
                                    .first_return = 1536,
                                    .first_packet_ns = 1000,
                                    .last_packet_ns = 2000,
                                    .labels_ns = 9000};
  EXPECT_EQ(header_of(sector, sensor::SensorModel::kHdl64e, true, 1500),
            (FrameWireHeader{.number = 7,
                             .points = 1500,
                             .first_packet_ns = 1000,
                             .last_packet_ns = 2000,
                             .labels_ns = 9000,
                             .sensor = 1,
                             .flags = kFrameSector | kFrameLate,
                             .first_return = 1536}));
}

TEST(LabelledFrameWire, OnlyTheSensorsThatAreDecodedHaveANumber) {
  const auto number_of = [](sensor::SensorModel model) {
    return int{header_of(status::FrameRecord{}, model, false, 0).sensor};
  };
  EXPECT_EQ(number_of(sensor::SensorModel::kHdl64e), 1);
  EXPECT_EQ(number_of(sensor::SensorModel::kHdl64eS1), 1);
  EXPECT_EQ(number_of(sensor::SensorModel::kVls128), 6);
  EXPECT_EQ(number_of(sensor::SensorModel::kVlp16HiRes), 0);
}

}  // namespace
}  // namespace terracut::stream
