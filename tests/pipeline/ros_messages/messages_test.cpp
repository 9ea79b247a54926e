// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "firmware_io/bag/cdr_reader.hpp"
#include "pipeline/ros_messages/cdr_writer.hpp"
#include "pipeline/ros_messages/diagnostic_array.hpp"
#include "pipeline/ros_messages/point_cloud.hpp"
#include "pipeline/ros_messages/transform.hpp"

namespace terracut::ros_messages {
namespace {

using Bytes = std::vector<std::byte>;

/// Reads a number where it is said to lie.
template <class Number>
Number at(const Bytes& message, std::size_t offset) {
  Number number;
  std::memcpy(&number, message.data() + offset, sizeof number);
  return number;
}

std::vector<int> numbers_of(const Bytes& message) {
  std::vector<int> numbers;
  for (const std::byte byte : message) numbers.push_back(std::to_integer<int>(byte));
  return numbers;
}

TEST(CdrWriter, AlignsNumbersBehindTheEncapsulationAndEndsTextsWithAZero) {
  Bytes message{std::byte{7}};
  CdrWriter to(message);
  to.add(std::uint8_t{1});
  to.add(std::string_view("ab"));
  to.add(std::uint16_t{2});
  to.add(1.0);
  to.add(true);
  const std::vector<int> expected{0,   1, 0, 0,  // encapsulation
                                  1,   0, 0, 0, 3, 0, 0,    0,    'a',
                                  'b', 0,           // padding behind the 1
                                  0,   2, 0, 0, 0,  // and around the 2
                                  0,   0, 0, 0, 0, 0, 0xF0, 0x3F, 1};
  EXPECT_EQ(numbers_of(message), expected);
}

publish::LabelledFrame small_frame() {
  publish::LabelledFrame frame;
  frame.record.info.first_packet_ns = 5'250'000'000;
  frame.record.info.last_packet_ns = 5'350'000'000;
  frame.points = {{1, 2, 3, 200, frame::Label::kObstacle, 63, 0.5F},
                  {4, 5, 6, 100, frame::Label::kGround, 0, 0.25F},
                  {7, 8, 9, 50, frame::Label::kOtherGround, 1, 0.125F},
                  {0, 0, 0, 0, frame::Label::kNone, 2, 0}};
  return frame;
}

constexpr std::size_t kWidthAt = 4 + 8 + 4 + 8 + 4;  // behind stamp, frame_id "vehicle", height

TEST(PointCloud, HoldsThePointsThatBelongToIt) {
  const publish::LabelledFrame frame = small_frame();
  const auto width_of = [&](CloudOf which) {
    Bytes message;
    write_point_cloud(frame, which, "vehicle", message);
    return at<std::uint32_t>(message, kWidthAt);
  };
  EXPECT_EQ(width_of(CloudOf::kAll), 4U);
  EXPECT_EQ(width_of(CloudOf::kGround), 2U) << "road and other ground";
  EXPECT_EQ(width_of(CloudOf::kRoad), 1U);
  EXPECT_EQ(width_of(CloudOf::kObstacles), 1U);
}

TEST(PointCloud, DescribesItsFieldsAsASensorMsgsPointCloud2Does) {
  publish::LabelledFrame frame = small_frame();
  for (const bool with_height : {false, true}) {
    if (with_height) frame.heights_m.assign(frame.points.size(), 0.5F);
    Bytes message;
    write_point_cloud(frame, CloudOf::kAll, "vehicle", message);
    bag::CdrReader from(message);
    EXPECT_EQ(from.number<std::int32_t>(), 5);
    EXPECT_EQ(from.number<std::uint32_t>(), 250'000'000U);
    EXPECT_EQ(from.text(), "vehicle");
    EXPECT_EQ(from.number<std::uint32_t>(), 1U) << "rows";
    EXPECT_EQ(from.number<std::uint32_t>(), 4U) << "columns";
    std::vector<std::string> fields;
    for (std::size_t left = from.length(1); left > 0; --left) {
      std::string field(from.text());
      field += " " + std::to_string(from.number<std::uint32_t>());
      field += " " + std::to_string(from.number<std::uint8_t>());
      field += " " + std::to_string(from.number<std::uint32_t>());
      fields.push_back(field);
    }
    std::vector<std::string> expected{"x 0 7 1",          "y 4 7 1",     "z 8 7 1",
                                      "intensity 12 7 1", "ring 16 4 1", "label 18 2 1",
                                      "time 20 7 1"};
    if (with_height) expected.emplace_back("height_above_ground 24 7 1");
    EXPECT_EQ(fields, expected);
    EXPECT_EQ(from.number<bool>(), false) << "little-endian";
    const std::size_t step = from.number<std::uint32_t>();
    EXPECT_EQ(step, with_height ? 28U : 24U);
    EXPECT_EQ(from.number<std::uint32_t>(), 4 * step);
    EXPECT_EQ(from.byte_sequence().size(), 4 * step);
    (void)from.number<bool>();  // is_dense
    EXPECT_FALSE(from.failed());
    (void)from.bytes(1);
    EXPECT_TRUE(from.failed()) << "nothing follows";
  }
}

/// Of a cloud that ends with it.
CloudPoint last_point(const Bytes& message) {
  return at<CloudPoint>(message, message.size() - 1 - sizeof(CloudPoint));
}

TEST(PointCloud, PointsHaveTheirTimeAfterTheStamp) {
  publish::LabelledFrame frame = small_frame();
  Bytes message;
  write_point_cloud(frame, CloudOf::kObstacles, "vehicle", message);
  EXPECT_EQ(at<std::int32_t>(message, 4), 5);
  EXPECT_EQ(at<std::uint32_t>(message, 8), 250'000'000U);
  const CloudPoint point = last_point(message);
  EXPECT_EQ(point.x_m, 1.0F);
  EXPECT_EQ(point.intensity, 200.0F);
  EXPECT_EQ(point.ring, 63);
  EXPECT_EQ(point.label, 99);
  EXPECT_EQ(point.time_s, 0.5F);

  frame.record.info.deskew.state = frame::DeskewState::kDone;
  frame.record.info.deskew.reference_ns = 6'250'000'000;
  write_point_cloud(frame, CloudOf::kObstacles, "vehicle", message);
  EXPECT_EQ(at<std::int32_t>(message, 4), 6) << "true for the instant it was deskewed to";
  EXPECT_EQ(last_point(message).time_s, -0.5F);
}

TEST(PointCloud, PointsHaveTheirHeightBehindThemWhereTheFrameHasIt) {
  publish::LabelledFrame frame = small_frame();
  Bytes without, with;
  write_point_cloud(frame, CloudOf::kGround, "vehicle", without);
  frame.heights_m = {1.5F, 0.25F, -0.5F, 0};
  write_point_cloud(frame, CloudOf::kGround, "vehicle", with);
  EXPECT_EQ(at<float>(with, with.size() - 1 - 4), -0.5F);
  EXPECT_EQ(at<float>(with, with.size() - 1 - 4 - 28), 0.25F);
  EXPECT_EQ(at<float>(with, with.size() - 1 - 28), 7.0F) << "x of the last";
  const auto text_of = [](const Bytes& message) {
    return std::string(reinterpret_cast<const char*>(message.data()), message.size());
  };
  EXPECT_NE(text_of(with).find("height_above_ground"), std::string::npos);
  EXPECT_EQ(text_of(without).find("height_above_ground"), std::string::npos);
}

TEST(PointCloud, PlacesAreRoundedToAStepThatNoSensorTellsApart) {
  publish::LabelledFrame frame = small_frame();
  frame.heights_m = {1.23456F, 0, 0, 0};
  frame.points[0].time_s = 0.0123456F;
  for (float x_m = -120; x_m < 120; x_m += 0.12345F) {
    frame.points[0].x_m = x_m;
    Bytes message;
    write_point_cloud(frame, CloudOf::kObstacles, "vehicle", message);
    const auto rounded_m = at<float>(message, message.size() - 1 - 28);
    EXPECT_EQ(rounded_m, std::nearbyint(x_m * 1024) / 1024);
    EXPECT_EQ(at<float>(message, message.size() - 1 - 4), 1264.0F / 1024);
    EXPECT_EQ(at<float>(message, message.size() - 1 - 8), 1618.0F / 131072) << "the time";
  }
}

TEST(PointCloud, PlacesOfSurveysFarAwayStayAsTheyAre) {
  publish::LabelledFrame frame = small_frame();
  frame.points[0].x_m = -5000.00049F;
  Bytes message;
  write_point_cloud(frame, CloudOf::kObstacles, "vehicle", message);
  EXPECT_EQ(last_point(message).x_m, -5000.00049F);
}

TEST(PointCloud, OfNoPointsIsOne) {
  Bytes message;
  write_point_cloud({}, CloudOf::kAll, "vehicle", message);
  EXPECT_EQ(at<std::uint32_t>(message, kWidthAt), 0U);
}

TEST(DiagnosticArray, HoldsEachDiagnosisWithItsValues) {
  const std::vector<publish::Diagnosis> diagnoses{
      {publish::Diagnosis::Severity::kWarn, "n", "m", "h", {{"k", "v"}}}};
  Bytes message;
  write_diagnostic_array(3'000'000'004, diagnoses, message);
  const std::vector<int> expected{
      0, 1, 0, 0, 3,   0, 0, 0, 4, 0, 0, 0, 1,   0, 0, 0, 0, 0, 0, 0,  // header
      1, 0, 0, 0, 1,   0, 0, 0, 2, 0, 0, 0, 'n', 0, 0, 0,              // one, level, name
      2, 0, 0, 0, 'm', 0, 0, 0, 2, 0, 0, 0, 'h', 0, 0, 0, 1, 0, 0, 0,  //
      2, 0, 0, 0, 'k', 0, 0, 0, 2, 0, 0, 0, 'v', 0};
  EXPECT_EQ(numbers_of(message), expected);
}

TEST(Transform, TellsWhereThePointsFrameLiesInTheSensors) {
  publish::RunFacts stream;
  stream.mount.height_m = 2;
  Bytes message;
  write_mount_transform(1'000'000'000, stream, message);
  const std::size_t end = message.size();
  EXPECT_EQ(at<double>(message, end - 5 * 8), -2.0) << "the ground is below the sensor";
  EXPECT_EQ(at<double>(message, end - 8), 1.0) << "nothing is turned";
  const std::string text(reinterpret_cast<const char*>(message.data()), end);
  EXPECT_LT(text.find("terracut_lidar"), text.find("terracut_ground"));
}

}  // namespace
}  // namespace terracut::ros_messages
