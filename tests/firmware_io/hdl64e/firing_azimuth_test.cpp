// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/firing_azimuth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calib/hdl64e/nominal_hdl64e.hpp"

namespace terracut::hdl64e {
namespace {

TEST(FiringAzimuth, StepIsExactAcrossTheSeam) {
  EXPECT_EQ(column_step_ticks(1000, 1086), 17'200);
  EXPECT_EQ(column_step_ticks(35'950, 36), 17'200);
  EXPECT_EQ(column_step_ticks(100, 142, true), 21'000);
}

TEST(FiringAzimuth, LaterLasersOfAColumnPointFurther) {
  // 17.28 hundredths of a degree a column; laser 31 fires 45.66 us after laser 0, of 48 us.
  EXPECT_EQ(firing_advance_ticks(17'280, 0), 0);
  EXPECT_EQ(firing_advance_ticks(17'280, 32), 0);
  EXPECT_NEAR(firing_advance_ticks(17'280, 31), 17'280 * 45.66 / 48.0, 1.0);
  EXPECT_EQ(firing_advance_ticks(17'280, 31), firing_advance_ticks(17'280, 63));
  EXPECT_NEAR(firing_advance_ticks(17'280, 5), 17'280 * (6.0 + 1.26) / 48.0, 1.0);
  EXPECT_NEAR(firing_advance_ticks(20'736, 31, true), 20'736 * (50.4 + 3.7) / 57.6, 1.0);
}

TEST(FiringAzimuth, BothSingleReturnCyclesAgreeToAHundredthOfAStep) {
  const auto other = firing_shares(kFiringTimesSingle57);
  for (std::size_t j = 0; j < other.size(); ++j) {
    EXPECT_LT(std::abs(static_cast<double>(other[j] - kFiringSharesSingle[j])) / (1 << 20), 0.013);
  }
}

TEST(FiringAzimuth, BeamsPassTheSeamIntoTheRightFrame) {
  EXPECT_EQ(packet::beam_azimuth(0, 0).frame, 0);
  EXPECT_EQ(packet::beam_azimuth(0, -1).frame, -1);
  EXPECT_EQ(packet::beam_azimuth(0, -1).in_revolution_ticks, packet::kRevolution_ticks - 1);
  EXPECT_EQ(packet::beam_azimuth(35'999, 999).frame, 0);
  EXPECT_EQ(packet::beam_azimuth(35'999, 1000).frame, 1);
  EXPECT_EQ(packet::beam_azimuth(35'999, 1000).in_revolution_ticks, 0);
  EXPECT_EQ(packet::beam_azimuth(36'000, 0).frame, 1);
  EXPECT_EQ(packet::beam_azimuth(-1, 0).frame, -1);
  EXPECT_EQ(packet::beam_azimuth(-36'000, -1).frame, -2);
}

TEST(FiringAzimuth, BeamAzimuthKeepsTheAngle) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> head(-1'000'000, 1'000'000);
  std::uniform_int_distribution<std::int32_t> offset(-1'100'000, 1'100'000);
  for (int n = 0; n < 100'000; ++n) {
    const std::int64_t rotor_cdeg = head(random);
    const std::int32_t offset_ticks = offset(random);
    const packet::BeamAzimuth beam = packet::beam_azimuth(rotor_cdeg, offset_ticks);
    ASSERT_GE(beam.in_revolution_ticks, 0);
    ASSERT_LT(beam.in_revolution_ticks, packet::kRevolution_ticks);
    ASSERT_EQ(beam.frame * packet::kRevolution_ticks + beam.in_revolution_ticks,
              rotor_cdeg * packet::kTicksPerCdeg + offset_ticks);
  }
}

TEST(FiringAzimuth, ColumnsCoverTheFrame) {
  EXPECT_EQ(packet::column_of(0, 2083), 0);
  EXPECT_EQ(packet::column_of(packet::kRevolution_ticks - 1, 2083), 2082);
  EXPECT_EQ(packet::column_of(packet::kRevolution_ticks / 2, 2083), 1041);
  EXPECT_EQ(packet::column_of(packet::kRevolution_ticks / 2 - 1, 2000), 999);
  EXPECT_EQ(packet::column_of(packet::kRevolution_ticks / 2, 2000), 1000);
}

TEST(FiringAzimuth, NoBeamLeavesTheSpread) {
  const BeamOffsets offsets(nominal_hdl64e());
  for (const std::int32_t step_ticks : {2'000, 17'280, 100'000}) {
    for (int laser = 0; laser < 64; ++laser) {
      EXPECT_GE(offsets.offset_ticks(step_ticks, laser), offsets.hindmost_ticks());
      EXPECT_LE(offsets.offset_ticks(step_ticks, laser), offsets.foremost_ticks(step_ticks));
    }
  }
}

}  // namespace
}  // namespace terracut::hdl64e
