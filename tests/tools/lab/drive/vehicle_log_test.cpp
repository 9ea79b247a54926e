// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/drive/vehicle_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/vehicle_log_reader.hpp"

namespace terracut::drive {
namespace {

using testing::HasSubstr;

TEST(VehicleLog, ASampleIsALineWithItsHundredthsHighByteFirst) {
  const std::array<vehicle::MotionSample, 2> samples{
      {{1'700'000'000'012'345'678, 20, 0.5}, {1'700'000'000'022'345'678, -1, -0.01}}};
  EXPECT_EQ(vehicle_log(samples),
            "(1700000000.012346) can0 1A0#1C200B3100000000\n"
            "(1700000000.022346) can0 1A0#FE98FFC700000001\n");
}

TEST(VehicleLog, WhatIsReadIsWhatWasWrittenToHalfAHundredth) {
  std::vector<vehicle::MotionSample> samples;
  for (std::int64_t i = 0; i < 600; ++i) {
    const auto share = static_cast<double>(i) / 600;
    samples.push_back(
        {1'700'000'000'000'000'000 + i * 10'000'000, 120 * share - 60, 2 * share - 1});
  }
  const auto read = terracut::test::samples_of(vehicle_log(samples));
  ASSERT_EQ(read.size(), samples.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp_ns, samples[i].stamp_ns);
    EXPECT_NEAR(read[i].speed_mps, samples[i].speed_mps, 0.0051 / 3.6);
    EXPECT_NEAR(read[i].yaw_rate_radps, samples[i].yaw_rate_radps, 0.0051 / 57.29);
  }
}

TEST(VehicleLog, WhatTheMessageCannotHoldIsItsGreatestValue) {
  const std::array<vehicle::MotionSample, 1> samples{{{0, 1e6, -1e6}}};
  EXPECT_THAT(vehicle_log(samples), HasSubstr("#7FFF8001"));
}

TEST(VehicleLog, TheDbcNamesTheMessageAndItsSignals) {
  const std::string dbc = vehicle_dbc();
  EXPECT_THAT(dbc, HasSubstr("BO_ 416 VEHICLE_MOTION: 8 VEHICLE\n"));
  EXPECT_THAT(dbc, HasSubstr(" SG_ SPEED : 7|16@0- (0.01,0) [-327.68|327.67] \"km/h\" "));
  EXPECT_THAT(dbc, HasSubstr(" SG_ YAW_RATE : 23|16@0- (0.01,0) [-327.68|327.67] \"deg/s\" "));
}

TEST(VehicleLog, BothFilesLieBesideTheCaptureAndAnErrorNamesTheFile) {
  const terracut::test::ScratchFolder folder;
  const std::array<vehicle::MotionSample, 1> samples{{{0, 1, 0}}};
  ASSERT_TRUE(write_vehicle_log(folder / "drive.pcap", samples));
  EXPECT_GT(std::filesystem::file_size(folder / "drive.can.log"), 0U);
  EXPECT_GT(std::filesystem::file_size(folder / "drive.can.dbc"), 0U);
  const auto refused = write_vehicle_log(folder / "drive.can.log" / "drive.pcap", samples);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("drive.can.dbc"));
}

}  // namespace
}  // namespace terracut::drive
