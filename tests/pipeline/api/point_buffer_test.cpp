// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/api/point_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace terracut {
namespace {

using F = FieldType;

/// Two rows of two points: x y z as floats, ring; behind each row two bytes of something else.
struct FourPoints {
  static constexpr std::size_t kStep = 16, kRowStep = 2 * kStep + 2;
  std::vector<PointField> fields{{"x", 0}, {"y", 4}, {"z", 8}, {"ring", 12, F::kUint16}};
  std::vector<std::byte> data = std::vector<std::byte>(2 * kRowStep, std::byte{0xA5});

  FourPoints() {
    for (std::size_t i = 0; i < 4; ++i) {
      std::byte* point = &data[i / 2 * kRowStep + i % 2 * kStep];
      const float place[] = {1.5F + static_cast<float>(i), -2, 0.25F};
      const auto ring = static_cast<std::uint16_t>(10 + i);
      std::memcpy(point, place, sizeof(place));
      std::memcpy(point + 12, &ring, sizeof(ring));
    }
  }
  /// Every value the other way round.
  void turn_round() {
    for (std::size_t i = 0; i < 4; ++i) {
      std::byte* point = &data[i / 2 * kRowStep + i % 2 * kStep];
      for (const auto& [at, bytes] : {std::pair{0, 4}, {4, 4}, {8, 4}, {12, 2}}) {
        std::reverse(point + at, point + at + bytes);
      }
    }
  }
  [[nodiscard]] PointBuffer buffer() const { return {data, fields, kStep, 2, 2, kRowStep}; }
};

TEST(PointBuffer, GivesThePointsOfItsRowsInTheirOrderWhateverLiesBetweenThem) {
  const FourPoints four;
  cloud::Cloud cloud;
  ASSERT_TRUE(unpack(four.buffer(), cloud));
  ASSERT_EQ(cloud.points.size(), 4U);
  EXPECT_EQ(cloud.points[3].x_m, 4.5F);
  EXPECT_EQ(cloud.points[3].y_m, -2.0F);
  EXPECT_EQ(cloud.laser, (std::vector<std::uint16_t>{10, 11, 12, 13}));
  EXPECT_EQ(cloud.rows, 2U);
}

TEST(PointBuffer, MayBeBigEndian) {
  FourPoints four;
  cloud::Cloud expected, cloud;
  ASSERT_TRUE(unpack(four.buffer(), expected));
  four.turn_round();
  PointBuffer buffer = four.buffer();
  buffer.big_endian = true;
  ASSERT_TRUE(unpack(buffer, cloud));
  EXPECT_EQ(cloud.laser, expected.laser);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(cloud.points[i].x_m, expected.points[i].x_m);
    EXPECT_EQ(cloud.points[i].z_m, expected.points[i].z_m);
  }
}

TEST(PointBuffer, IsRefusedByTheNameOfWhatIsWrongWithIt) {
  FourPoints four;
  const auto fault_of = [&](auto change) {
    PointBuffer buffer = four.buffer();
    std::vector<PointField> fields = four.fields;
    change(buffer, fields);
    buffer.fields = fields;
    cloud::Cloud cloud;
    const auto read = unpack(buffer, cloud);
    return read ? BufferFault::kCount : read.error().fault;
  };
  using B = PointBuffer;
  using Fields = std::vector<PointField>;
  EXPECT_EQ(fault_of([](B&, Fields&) {}), BufferFault::kCount);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[1].name = "why"; }), BufferFault::kNoPosition);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f.clear(); }), BufferFault::kNoPosition);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[0].type = static_cast<F>(0); }),
            BufferFault::kUnknownType);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[3].type = static_cast<F>(9); }),
            BufferFault::kUnknownType);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[3].offset = 15; }), BufferFault::kBeyondPoint);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[3].offset = 0xFFFFFFFF; }), BufferFault::kBeyondPoint);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[2].count = 3; }), BufferFault::kBeyondPoint);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[2].count = std::size_t{1} << 62; }),
            BufferFault::kBeyondPoint);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.point_step = 0; }), BufferFault::kBeyondPoint);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.width = 0; }), BufferFault::kNoPoints);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.height = 0; }), BufferFault::kNoPoints);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.width = std::size_t{1} << 61; }),
            BufferFault::kTooManyPoints);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.width = 3; }), BufferFault::kSizes);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.height = 3; }), BufferFault::kSizes);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.row_step = 31; }), BufferFault::kSizes);
  EXPECT_EQ(fault_of([](B& b, Fields&) { b.data = b.data.first(67); }), BufferFault::kSizes);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[3] = {"ring", 0}; }), BufferFault::kCount);
  EXPECT_EQ(fault_of([](B&, Fields& f) { f[3] = {"ring", 4}; }), BufferFault::kLaserNumber);
}

TEST(PointBuffer, IsNotAskedForTheLaserOfPointsThatAreNoReturns) {
  FourPoints four;
  const auto ring = std::uint16_t{65535};
  std::memset(four.data.data(), 0, 12);
  std::memcpy(four.data.data() + 12, &ring, sizeof(ring));
  cloud::Cloud cloud;
  ASSERT_TRUE(unpack(four.buffer(), cloud));
  EXPECT_EQ(cloud.laser, (std::vector<std::uint16_t>{0, 11, 12, 13}));
}

TEST(PointBuffer, FaultsHaveNames) {
  EXPECT_EQ(to_string(BufferFault::kSizes), "wrong_sizes");
  EXPECT_EQ(to_string(BufferFault::kCount), "unknown");
}

}  // namespace
}  // namespace terracut
