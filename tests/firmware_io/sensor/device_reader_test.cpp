// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/device_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"

namespace terracut::sensor {
namespace {

using ruby128::ruby128_wire::Difop;
using testing::HasSubstr;

constexpr SensorModel kRuby = SensorModel::kRuby128;

Difop difop_of_unit(std::uint8_t serial, double elevations_up_deg = 0) {
  ruby128::Ruby128Calibration calibration = ruby128::nominal_ruby128();
  for (ruby128::Ruby128Channel& channel : calibration.channels) {
    channel.elevation_rad += beams::deg_to_rad(elevations_up_deg);
  }
  Difop difop = ruby128::blank_difop();
  difop.serial = {0, 0, 0, 0, 0, serial};
  ruby128::set_calibration(difop, calibration);
  return difop;
}

const ruby128::Ruby128Calibration& told(const DeviceReader& reader) {
  return std::get<ruby128::Ruby128Calibration>(*reader.calibration(kRuby));
}

double lowest_deg(const DeviceReader& reader) {
  return beams::rad_to_deg(told(reader).channels[35].elevation_rad);
}

TEST(DeviceReader, KnowsNothingBeforeTheFirstPacket) {
  const DeviceReader reader;
  EXPECT_FALSE(reader.has_calibration(kRuby));
  EXPECT_FALSE(reader.newest().has_value());
  EXPECT_EQ(reader.calibration(kRuby).error().code, ErrorCode::kNoCalibration);
  EXPECT_THAT(reader.calibration(kRuby).error().message, HasSubstr("no DIFOP packet has come"));
}

TEST(DeviceReader, TakesTheCalibrationOfTheFirstPacket) {
  DeviceReader reader;
  const Difop difop = difop_of_unit(7);
  EXPECT_TRUE(reader.add(ruby128::payload_of(difop)));
  EXPECT_TRUE(reader.has_calibration(kRuby));
  EXPECT_EQ(fingerprint(told(reader)), fingerprint(ruby128::nominal_ruby128()));
  EXPECT_EQ(reader.counters().packets, 1U);
}

TEST(DeviceReader, LeavesOtherPayloadsAlone) {
  DeviceReader reader;
  EXPECT_FALSE(reader.add({}));
  const auto data = ruby128::blank_packet();
  EXPECT_FALSE(reader.add(ruby128::payload_of(data)));
  const std::vector<std::uint8_t> longer(1249, 0xA5);
  EXPECT_FALSE(reader.add(longer));
  EXPECT_EQ(reader.counters().packets, 0U);
  EXPECT_FALSE(reader.newest().has_value());
}

TEST(DeviceReader, KeepsTheNewestFactsAndTheFirstCalibration) {
  DeviceReader reader;
  Difop difop = difop_of_unit(7);
  difop.rpm_actual = packet::Be16::of(598);
  reader.add(ruby128::payload_of(difop));
  difop = difop_of_unit(7, 0.5);
  difop.rpm_actual = packet::Be16::of(601);
  reader.add(ruby128::payload_of(difop));
  EXPECT_EQ(reader.newest()->rpm_actual.value(), 601);
  EXPECT_NEAR(lowest_deg(reader), -25.0, 1e-9);
  EXPECT_EQ(reader.counters().angle_changes, 1U);
  EXPECT_EQ(reader.counters().serial_changes, 0U);
}

TEST(DeviceReader, CountsEveryChangeOfSerialNumberAndAngles) {
  DeviceReader reader;
  const Difop a = difop_of_unit(1), b = difop_of_unit(2, 0.1);
  for (const Difop* difop : {&a, &a, &b, &a, &b, &b}) reader.add(ruby128::payload_of(*difop));
  EXPECT_EQ(reader.counters().packets, 6U);
  EXPECT_EQ(reader.counters().serial_changes, 3U);
  EXPECT_EQ(reader.counters().angle_changes, 3U);
  EXPECT_EQ(reader.newest()->serial[5], 2);
}

TEST(DeviceReader, SeesAChangeOfAzimuthOffsetsAlone) {
  DeviceReader reader;
  Difop difop = difop_of_unit(1);
  reader.add(ruby128::payload_of(difop));
  difop.azimuth_offsets[127].magnitude = packet::Be16::of(594);
  reader.add(ruby128::payload_of(difop));
  EXPECT_EQ(reader.counters().angle_changes, 1U);
}

TEST(DeviceReader, WaitsForAnglesAndSaysWhyThereAreNone) {
  DeviceReader reader;
  const Difop unset = ruby128::blank_difop();
  reader.add(ruby128::payload_of(unset));
  reader.add(ruby128::payload_of(unset));
  EXPECT_FALSE(reader.has_calibration(kRuby));
  EXPECT_THAT(reader.calibration(kRuby).error().message, HasSubstr("hold no angles"));

  Difop implausible = difop_of_unit(1);
  implausible.elevations[0] = implausible.elevations[1];
  reader.add(ruby128::payload_of(implausible));
  EXPECT_FALSE(reader.has_calibration(kRuby));
  EXPECT_THAT(reader.calibration(kRuby).error().message, HasSubstr("channels 1 and 2"));

  const Difop good = difop_of_unit(1);
  reader.add(ruby128::payload_of(good));
  reader.add(ruby128::payload_of(unset));
  EXPECT_TRUE(reader.has_calibration(kRuby));
  EXPECT_NEAR(lowest_deg(reader), -25.0, 1e-9);
}

}  // namespace
}  // namespace terracut::sensor
