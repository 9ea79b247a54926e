// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/moved_cloud.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "terracut/segmenter.hpp"

namespace terracut::dds {
namespace {

/// A quarter turn to the left, then 10 m ahead and 2 m up.
constexpr mount::RigidTransform kTurn{0, -1, 0, 10, 1, 0, 0, 0, 0, 0, 1, 2};

/// Two rows of one point: a byte, x and y as FLOAT32, z as FLOAT64; behind each row three bytes.
struct TwoPoints {
  static constexpr std::uint32_t kStep = 17, kRowStep = 20;
  std::string frame = "lidar", ring = "ring", x = "x", y = "y", z = "z";
  std::vector<sensor_msgs_msg_dds__PointField_> fields{
      {ring.data(), 0, 2, 1}, {x.data(), 1, 7, 1}, {y.data(), 5, 7, 1}, {z.data(), 9, 8, 1}};
  std::vector<std::uint8_t> data;
  RosCloud cloud{};

  explicit TwoPoints(bool is_bigendian) : data(2 * std::size_t{kRowStep}, 0xA5) {
    put(0, 3.0F, 4.0F, 5.0, is_bigendian);
    put(1, std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0, is_bigendian);
    cloud.header = {{7, 8}, frame.data()};
    cloud.height = 2;
    cloud.width = 1;
    cloud.fields = {4, 4, fields.data(), false};
    cloud.is_bigendian = is_bigendian;
    cloud.point_step = kStep;
    cloud.row_step = kRowStep;
    cloud.data = {40, 40, data.data(), false};
  }

 private:
  void put(std::size_t row, float x_m, float y_m, double z_m, bool is_bigendian) {
    std::uint8_t* point = &data[row * kRowStep];
    auto x_bits = std::bit_cast<std::uint32_t>(x_m), y_bits = std::bit_cast<std::uint32_t>(y_m);
    auto z_bits = std::bit_cast<std::uint64_t>(z_m);
    if (is_bigendian) {
      x_bits = __builtin_bswap32(x_bits);
      y_bits = __builtin_bswap32(y_bits);
      z_bits = __builtin_bswap64(z_bits);
    }
    std::memcpy(point + 1, &x_bits, 4);
    std::memcpy(point + 5, &y_bits, 4);
    std::memcpy(point + 9, &z_bits, 8);
  }
};

class MovedCloudInOrder : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BigEndianOrNot, MovedCloudInOrder, testing::Bool());

TEST_P(MovedCloudInOrder, HasItsPointsInTheOtherFrameAndAllElseAsItWas) {
  TwoPoints two(GetParam());
  const std::vector<std::uint8_t> before = two.data;
  MovedCloud moved;
  ASSERT_TRUE(MovedCloud::can_move(two.cloud));
  const RosCloud& cloud = moved.move(two.cloud, kTurn, "base_link");

  EXPECT_STREQ(cloud.header.frame_id, "base_link");
  EXPECT_EQ(cloud.header.stamp.sec, 7);
  EXPECT_EQ(cloud.point_step, TwoPoints::kStep);
  ASSERT_EQ(cloud.data._length, 40U);
  std::uint32_t x_bits = 0, y_bits = 0;
  std::uint64_t z_bits = 0;
  const std::uint8_t* point = cloud.data._buffer;
  std::memcpy(&x_bits, point + 1, 4);
  std::memcpy(&y_bits, point + 5, 4);
  std::memcpy(&z_bits, point + 9, 8);
  if (GetParam()) {
    x_bits = __builtin_bswap32(x_bits);
    y_bits = __builtin_bswap32(y_bits);
    z_bits = __builtin_bswap64(z_bits);
  }
  EXPECT_EQ(std::bit_cast<float>(x_bits), 6.0F);
  EXPECT_EQ(std::bit_cast<float>(y_bits), 3.0F);
  EXPECT_EQ(std::bit_cast<double>(z_bits), 7.0);
  EXPECT_EQ(point[0], 0xA5) << "another field";
  EXPECT_EQ(point[TwoPoints::kStep], 0xA5) << "behind the row";
  std::uint32_t y_of_second = 0;
  std::memcpy(&y_of_second, point + TwoPoints::kRowStep + 5, 4);
  if (GetParam()) y_of_second = __builtin_bswap32(y_of_second);
  EXPECT_NE(std::bit_cast<float>(y_of_second), std::bit_cast<float>(y_of_second))
      << "a point that is none stays none";
  EXPECT_EQ(two.data, before) << "the original is not touched";
}

TEST(MovedCloud, NeedsCoordinatesWithFractions) {
  TwoPoints two(false);
  two.fields[3].datatype = static_cast<std::uint8_t>(FieldType::kInt16);
  EXPECT_FALSE(MovedCloud::can_move(two.cloud));
}

}  // namespace
}  // namespace terracut::dds
