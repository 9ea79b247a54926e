// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/derived_cloud.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

namespace terracut::dds {
namespace {

using frame::Label;

/// Two rows of three points of five bytes; behind each row two bytes of something else.
struct SixPoints {
  std::string frame = "lidar", a = "a", label = "label";
  std::vector<sensor_msgs_msg_dds__PointField_> fields{{a.data(), 0, 2, 1},
                                                       {label.data(), 4, 2, 1}};
  std::vector<std::uint8_t> data;
  RosCloud cloud{};
  const std::vector<Label> labels{Label::kGround,   Label::kObstacle,    Label::kNone,
                                  Label::kObstacle, Label::kOtherGround, Label::kGround};

  SixPoints() {
    for (std::uint8_t i = 0; i < 34; ++i) data.push_back(i);
    cloud.header = {{7, 8}, frame.data()};
    cloud.height = 2;
    cloud.width = 3;
    cloud.fields = {2, 2, fields.data(), false};
    cloud.is_bigendian = true;
    cloud.point_step = 5;
    cloud.row_step = 17;
    cloud.data = {34, 34, data.data(), false};
  }
};

std::vector<int> bytes_of(const RosCloud& cloud) {
  const std::span bytes(cloud.data._buffer, cloud.data._length);
  return {bytes.begin(), bytes.end()};
}

TEST(DerivedCloud, HasTheChosenPointsByteForByteAndSaysOfThemWhatTheCloudSaid) {
  const SixPoints six;
  DerivedCloud derived;
  const RosCloud& obstacles =
      derived.select(six.cloud, six.labels, [](Label label) { return label == Label::kObstacle; });
  EXPECT_EQ(bytes_of(obstacles), (std::vector{5, 6, 7, 8, 9, 17, 18, 19, 20, 21}));
  EXPECT_EQ(obstacles.header.stamp.sec, 7);
  EXPECT_EQ(obstacles.header.stamp.nanosec, 8U);
  EXPECT_STREQ(obstacles.header.frame_id, "lidar");
  EXPECT_EQ(obstacles.height, 1U);
  EXPECT_EQ(obstacles.width, 2U);
  EXPECT_EQ(obstacles.point_step, 5U);
  EXPECT_EQ(obstacles.row_step, 10U);
  EXPECT_EQ(obstacles.fields._length, 2U);
  EXPECT_STREQ(obstacles.fields._buffer[0].name, "a");
  EXPECT_TRUE(obstacles.is_bigendian);
  EXPECT_TRUE(obstacles.is_dense);
}

TEST(DerivedCloud, MayHaveNoPoints) {
  const SixPoints six;
  DerivedCloud derived;
  const RosCloud& none = derived.select(six.cloud, six.labels, [](Label) { return false; });
  EXPECT_EQ(none.width, 0U);
  EXPECT_EQ(none.data._length, 0U);
}

TEST(DerivedCloud, HasALabelBehindEveryPointInPlaceOfTheirOwn) {
  const SixPoints six;
  DerivedCloud derived;
  const RosCloud& labelled = derived.with_labels(six.cloud, six.labels);
  EXPECT_EQ(labelled.height, 2U);
  EXPECT_EQ(labelled.width, 3U);
  EXPECT_EQ(labelled.point_step, 8U);
  ASSERT_EQ(labelled.fields._length, 2U);
  EXPECT_STREQ(labelled.fields._buffer[1].name, "label");
  EXPECT_EQ(labelled.fields._buffer[1].offset, 5U);
  const std::vector<int> bytes = bytes_of(labelled);
  ASSERT_EQ(bytes.size(), 48U);
  EXPECT_EQ(std::vector(bytes.begin() + 24, bytes.begin() + 32),
            (std::vector{17, 18, 19, 20, 21, 99, 0, 0}));
  std::vector<int> classes;
  for (std::size_t i = 5; i < bytes.size(); i += 8) classes.push_back(bytes[i]);
  EXPECT_EQ(classes, (std::vector{40, 99, 0, 99, 49, 40}));
}

TEST(DerivedCloud, HasAHeightBehindEachLabelInTheByteOrderOfTheCloud) {
  SixPoints six;
  const std::vector heights_m{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, -2.0F};
  for (const bool is_bigendian : {true, false}) {
    six.cloud.is_bigendian = is_bigendian;
    DerivedCloud derived;
    const RosCloud& labelled = derived.with_labels(six.cloud, six.labels, heights_m);
    EXPECT_EQ(labelled.point_step, 12U);
    ASSERT_EQ(labelled.fields._length, 3U);
    EXPECT_STREQ(labelled.fields._buffer[2].name, "height_above_ground");
    EXPECT_EQ(labelled.fields._buffer[2].offset, 8U);
    EXPECT_EQ(labelled.fields._buffer[2].datatype, 7U);
    const std::vector<int> bytes = bytes_of(labelled);
    ASSERT_EQ(bytes.size(), 72U);
    const std::vector<int> last(bytes.end() - 4, bytes.end());
    EXPECT_EQ(last, is_bigendian ? (std::vector{0xC0, 0, 0, 0}) : (std::vector{0, 0, 0, 0xC0}));
  }
}

}  // namespace
}  // namespace terracut::dds
