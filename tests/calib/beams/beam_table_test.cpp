// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "calib/beams/angle.hpp"
#include "calib/beams/beam_table.hpp"
#include "calib/mount/ring_profile.hpp"

namespace terracut::beams {
namespace {

double elevation_deg(const BeamTable& table, std::size_t laser) {
  return beams::rad_to_deg(table.lasers[laser].elevation_rad);
}

TEST(FactoryTables, TheVlp16sLasersAreTwoDegreesApartInTwoCombs) {
  const auto table = built_in_table(sensor::SensorModel::kVlp16);
  for (std::size_t laser = 0; laser < 16; ++laser) {
    const auto number = static_cast<double>(laser);
    EXPECT_NEAR(elevation_deg(table, laser), laser % 2 == 0 ? number - 15 : number, 1e-9);
    // The higher a beam points, the lower it begins, by up to 11.2 mm.
    EXPECT_NEAR(table.lasers[laser].vert_offset_m,
                -0.0418 * std::tan(table.lasers[laser].elevation_rad), 5e-5);
  }
}

TEST(FactoryTables, TheHdl32esLasersAreFourThirdsOfADegreeApart) {
  const auto table = built_in_table(sensor::SensorModel::kHdl32e);
  for (std::size_t laser = 0; laser < 32; ++laser) {
    const double first_deg = laser % 2 == 0 ? -92.0 / 3 : -28.0 / 3;
    EXPECT_NEAR(elevation_deg(table, laser), first_deg + 4.0 / 3 * static_cast<double>(laser / 2),
                0.0051);
    EXPECT_EQ(table.lasers[laser].azimuth_offset_rad, 0);
  }
}

TEST(FactoryTables, TheVls128sBeamsFanOutEightBySide) {
  const auto table = built_in_table(sensor::SensorModel::kVls128);
  for (std::size_t laser = 0; laser < 128; ++laser) {
    EXPECT_NEAR(beams::rad_to_deg(table.lasers[laser].azimuth_offset_rad),
                beams::rad_to_deg(table.lasers[laser % 8].azimuth_offset_rad), 1e-9);
  }
  EXPECT_NEAR(beams::rad_to_deg(table.lasers[0].azimuth_offset_rad), 6.354, 1e-9);
  EXPECT_NEAR(beams::rad_to_deg(table.lasers[7].azimuth_offset_rad), -6.354, 1e-9);
}

TEST(FactoryTables, HaveARowAndAFingerprintOfTheirOwn) {
  std::set<std::uint64_t> fingerprints;
  std::size_t models = 0;
  for (const sensor::SensorRow& model : sensor::kSensorTable) {
    if (model.lasers.empty()) continue;
    ++models;
    SCOPED_TRACE(model.name);
    const auto table = built_in_table(model.model);
    ASSERT_EQ(table.lasers.size(), model.lasers.size());
    EXPECT_THAT(table.origin, testing::HasSubstr(std::string(model.name)));
    fingerprints.insert(fingerprint(table));
    const std::vector<int> rows = rows_by_elevation(table);
    std::vector<double> by_row(rows.size(), 100);
    for (std::size_t laser = 0; laser < rows.size(); ++laser) {
      by_row[static_cast<std::size_t>(rows[laser])] = elevation_deg(table, laser);
    }
    for (std::size_t row = 1; row < by_row.size(); ++row) {
      EXPECT_GT(by_row[row], by_row[row - 1] + 0.005) << row;
    }
    EXPECT_EQ(mount::ring_profile(table, {}).rings.size(), rows.size());
  }
  EXPECT_EQ(fingerprints.size(), models);
}

TEST(FactoryTables, ARingLiesWhereItsBeamMeetsTheGround) {
  const auto profile =
      mount::ring_profile(built_in_table(sensor::SensorModel::kVlp16), {.height_m = 1.5});
  EXPECT_NEAR(profile.rings[0].ground_distance_m,
              (1.5 + 0.0112) / std::tan(beams::deg_to_rad(15.0)), 1e-9);
  EXPECT_TRUE(std::isinf(profile.rings[8].ground_distance_m));  // one degree up
}

TEST(VelodyneTable, WithOtherThanItsModelsLasersIsRefused) {
  EXPECT_TRUE(validate(built_in_table(sensor::SensorModel::kVls128)));
  EXPECT_FALSE(validate({sensor::SensorModel::kVlp16, {{}}, "by hand"}));
  BeamTable broken = built_in_table(sensor::SensorModel::kVlp16);
  broken.lasers[3].elevation_rad = std::nan("");
  EXPECT_FALSE(validate(broken));
}

}  // namespace
}  // namespace terracut::beams
