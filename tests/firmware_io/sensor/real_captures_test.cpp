// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Real captures of other Velodyne models (data not part of the project; skipped where absent).
#include <gtest/gtest.h>

#include "firmware_io/sensor/capture_survey.hpp"
#include "tests/firmware_io/capture/capture_bytes.hpp"
#include "tests/support/places.hpp"

namespace terracut::sensor {
namespace {

struct RealCapture {
  const char* file;
  SensorModel sensor;
  std::uint64_t data_packets;
  std::uint64_t position_packets;
  double spin_rpm;
};

class RealCaptures : public testing::TestWithParam<RealCapture> {
 protected:
  void SetUp() override {
    path_ = test::shared_data("pcap") / GetParam().file;
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << path_ << " is not here";
  }
  std::filesystem::path path_;
};

TEST_P(RealCaptures, AreSurveyedByModelAndCount) {
  const auto survey = capture::CaptureSource::open(path_).map(
      [](capture::CaptureSource source) { return survey_capture(source); });
  ASSERT_TRUE(survey) << survey.error().message;
  EXPECT_FALSE(survey->broke_off);
  EXPECT_EQ(survey->counters.refused_total(), 0U);
  EXPECT_EQ(survey->counters.frames, GetParam().data_packets + GetParam().position_packets);
  ASSERT_EQ(survey->streams.size(), GetParam().position_packets == 0 ? 1U : 2U);
  EXPECT_EQ(survey->streams[0].sensor, GetParam().sensor)
      << to_string(survey->streams[0].sensor) << ", " << survey->streams[0].sensor_hints;
  EXPECT_EQ(survey->streams[0].packets, GetParam().data_packets);
  EXPECT_FALSE(survey->streams[0].hdl64e);
  ASSERT_TRUE(survey->streams[0].head);
  EXPECT_NEAR(survey->streams[0].head->spin_rpm, GetParam().spin_rpm, 1);
  EXPECT_EQ(survey->streams[0].head->packets_lost, 0U);
  if (GetParam().position_packets != 0) {
    EXPECT_EQ(survey->streams[1].sensor, SensorModel::kVelodynePosition);
    EXPECT_EQ(survey->streams[1].destination_port, 8308);
  }
}

TEST_P(RealCaptures, AreFilteredByPortAndSource) {
  auto source = capture::CaptureSource::open(path_, {.port = 2368});
  ASSERT_TRUE(source);
  std::uint64_t packets = 0;
  std::uint32_t sender = 0;
  for (auto next = source->next(); next && *next; next = source->next()) {
    EXPECT_EQ((*next)->payload.size(), 1206U);
    sender = (*next)->source_address;
    ++packets;
  }
  EXPECT_EQ(packets, GetParam().data_packets);
  EXPECT_EQ(source->counters().other_port, GetParam().position_packets);

  auto stranger = capture::CaptureSource::open(path_, {.port = 2368, .source_address = sender + 1});
  ASSERT_TRUE(stranger);
  const auto next = stranger->next();
  ASSERT_TRUE(next);
  EXPECT_FALSE(next->has_value());
  EXPECT_EQ(stranger->counters().other_source, GetParam().data_packets);
}

TEST_P(RealCaptures, KeepTheirPacketsWhenCutInTheMiddle) {
  const test::Bytes whole = test::read_file(path_);
  const std::span cut = std::span(whole).first(whole.size() / 2);
  auto source = capture::CaptureSource::open_memory(cut, "half");
  ASSERT_TRUE(source);
  std::uint64_t packets = 0;
  auto next = source->next();
  for (; next && *next; next = source->next()) ++packets;
  EXPECT_FALSE(next);
  EXPECT_GT(packets, GetParam().data_packets / 3);
}

INSTANTIATE_TEST_SUITE_P(
    Velodyne, RealCaptures,
    testing::Values(RealCapture{"sample_velodyne_hdl32.pcap", SensorModel::kHdl32e, 500, 0, 542.3},
                    RealCapture{"sample_velodyne_vlp16_gps.pcap", SensorModel::kVlp16, 293, 57,
                                599.1},
                    RealCapture{"vlp16_nebula.pcap", SensorModel::kVlp16, 603, 0, 600},
                    RealCapture{"vlp32_nebula.pcap", SensorModel::kVlp32c, 379, 0, 600},
                    RealCapture{"vls128_nebula.pcap", SensorModel::kVls128, 2193, 0, 599.9}),
    [](const auto& capture) {
      std::string name = capture.param.file;
      return name.substr(0, name.find('.'));
    });

}  // namespace
}  // namespace terracut::sensor
