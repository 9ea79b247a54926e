// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/difop_angles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "calib/beams/angle.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"

namespace terracut::ruby128 {
namespace {

using ruby128_wire::Angle;
using ruby128_wire::Difop;
using testing::AllOf;
using testing::HasSubstr;

Difop nominal_difop() {
  Difop difop = blank_difop();
  set_calibration(difop, nominal_ruby128());
  return difop;
}

void expect_refused(const Difop& difop, ErrorCode code,
                    const testing::Matcher<const std::string&>& message) {
  const auto calibration = calibration_of(difop);
  ASSERT_FALSE(calibration.has_value());
  EXPECT_EQ(calibration.error().code, code);
  EXPECT_THAT(calibration.error().message, message);
}

TEST(DifopAngles, BytesMeanWhatTheFormatSays) {
  Difop difop = nominal_difop();
  const auto payload = payload_of(difop);
  // Channel 36, -25.00 degrees, and channel 1, +5.95.
  EXPECT_EQ(std::vector<int>(payload.begin() + 468 + 35 * 3, payload.begin() + 468 + 36 * 3),
            (std::vector<int>{0x01, 0x09, 0xC4}));
  EXPECT_EQ(std::vector<int>(payload.begin() + 852, payload.begin() + 855),
            (std::vector<int>{0x00, 0x02, 0x53}));
  const auto read = calibration_of(difop);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->channels[35].elevation_rad, beams::deg_to_rad(-25.0));
  EXPECT_EQ(read->channels[0].azimuth_offset_rad, beams::deg_to_rad(5.95));
  EXPECT_EQ(read->origin, "DIFOP packets");
  EXPECT_FALSE(read->nominal);
}

TEST(DifopAngles, CarryATableToHundredthsOfADegreeWithItsFingerprint) {
  const Ruby128Calibration nominal = nominal_ruby128();
  const Difop difop = nominal_difop();
  const auto read = calibration_of(difop);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(fingerprint(*read), fingerprint(nominal));
  for (std::size_t i = 0; i < nominal.channels.size(); ++i) {
    EXPECT_NEAR(beams::rad_to_deg(read->channels[i].elevation_rad),
                beams::rad_to_deg(nominal.channels[i].elevation_rad), 0.005001);
    EXPECT_NEAR(beams::rad_to_deg(read->channels[i].azimuth_offset_rad),
                beams::rad_to_deg(nominal.channels[i].azimuth_offset_rad), 1e-12);
  }
}

TEST(DifopAngles, ARoundTripOfWhatPacketsCanCarryIsExact) {
  const auto once = calibration_of(nominal_difop());
  Difop again = blank_difop();
  set_calibration(again, *once);
  EXPECT_EQ(calibration_of(again)->channels, once->channels);
}

TEST(DifopAngles, NoNegativeZero) {
  Difop difop = nominal_difop();
  difop.elevations[1] = {kDifopMinus, packet::Be16::of(0)};
  const auto read = calibration_of(difop);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_FALSE(std::signbit(read->channels[1].elevation_rad));
}

TEST(DifopAngles, AUnitThatWasNeverCalibratedSaysSoAndWhatToDo) {
  expect_refused(blank_difop(), ErrorCode::kNoCalibration,
                 AllOf(HasSubstr("this unit's DIFOP packets hold no angles"),
                       HasSubstr("give the unit's angle.csv with --calibration FILE")));
  Difop zeros = blank_difop();
  zeros.elevations = {};
  zeros.azimuth_offsets = {};
  expect_refused(zeros, ErrorCode::kNoCalibration, HasSubstr("all elevations are zero"));
}

TEST(DifopAngles, OneUnsetAngleIsEnough) {
  Difop difop = nominal_difop();
  difop.azimuth_offsets[127] = {0xFF, packet::Be16::of(0xFFFF)};
  expect_refused(difop, ErrorCode::kNoCalibration, HasSubstr("azimuth offset of channel 128"));
  // Also beside a sign that means nothing at all.
  difop.elevations[0].sign = 0x37;
  expect_refused(difop, ErrorCode::kNoCalibration, HasSubstr("azimuth offset of channel 128"));
}

TEST(DifopAngles, NamesASignThatMeansNothing) {
  Difop difop = nominal_difop();
  difop.elevations[4].sign = 0x37;
  expect_refused(difop, ErrorCode::kMalformed,
                 AllOf(HasSubstr("elevation of channel 5"), HasSubstr("0x37"),
                       HasSubstr("--calibration FILE")));
}

TEST(DifopAngles, NamesWhatIsNotPlausible) {
  Difop difop = nominal_difop();
  difop.elevations[35] = {kDifopMinus, packet::Be16::of(9000)};
  expect_refused(difop, ErrorCode::kMalformed,
                 AllOf(HasSubstr("DIFOP packets"), HasSubstr("channel 36 of 128"),
                       HasSubstr("-90 deg"), HasSubstr("--calibration FILE")));
  Difop no_offsets = nominal_difop();
  no_offsets.azimuth_offsets = {};
  expect_refused(no_offsets, ErrorCode::kMalformed, HasSubstr("azimuth offsets"));
}

TEST(DifopAngles, KnowsARubyPlus) {
  constexpr std::pair<double, double> kFirst_deg[] = {{-11.78, 5.94}, {-10.37, 2.39},
                                                      {-9.27, -1.15}, {-8.38, -4.69},
                                                      {-16.07, 4.70}, {-25.10, 1.17}};
  Ruby128Calibration calibration = nominal_ruby128();
  for (std::size_t i = 0; i < std::size(kFirst_deg); ++i) {
    calibration.channels[i] = {beams::deg_to_rad(kFirst_deg[i].first),
                               beams::deg_to_rad(kFirst_deg[i].second)};
  }
  Difop difop = blank_difop();
  set_calibration(difop, calibration);
  expect_refused(difop, ErrorCode::kUnsupported, HasSubstr("RS-Ruby Plus"));
}

TEST(DifopAngles, AnglesThatDoNotFitEndAtTheLastThatDoes) {
  Ruby128Calibration calibration = nominal_ruby128();
  calibration.channels[0] = {1e9, -1e9};
  calibration.channels[1] = {std::nan(""), 0};
  Difop difop = blank_difop();
  set_calibration(difop, calibration);
  const auto bytes = [](const Angle& angle) {
    return std::pair<int, int>(angle.sign, angle.magnitude.value());
  };
  EXPECT_EQ(bytes(difop.elevations[0]), (std::pair<int, int>(0, 65535)));
  EXPECT_EQ(bytes(difop.azimuth_offsets[0]), (std::pair<int, int>(1, 65535)));
  EXPECT_EQ(bytes(difop.elevations[1]), (std::pair<int, int>(1, 65535)));
}

}  // namespace
}  // namespace terracut::ruby128
