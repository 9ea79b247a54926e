// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/nominal_hdl64e.hpp"

#include <algorithm>
#include <set>

#include "calib/beams/angle.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::hdl64e {
namespace {

TEST(NominalHdl64e, IsAPlausibleUnit) {
  const Status status = validate(nominal_hdl64e());
  EXPECT_TRUE(status.has_value()) << status.error().message;
}

TEST(NominalHdl64e, HasTheUsualSpansAndBlocks) {
  const Hdl64eCalibration unit = nominal_hdl64e();
  for (std::size_t i = 0; i < unit.lasers.size(); ++i) {
    const Hdl64eLaser& laser = unit.lasers[i];
    const double elevation_deg = beams::rad_to_deg(laser.vert_correction_rad);
    EXPECT_TRUE(i < 32 ? elevation_deg > -8.4 && elevation_deg < 2.1
                       : elevation_deg > -25.0 && elevation_deg < -8.7)
        << i << ": " << elevation_deg;
    EXPECT_LE(std::abs(beams::rad_to_deg(laser.rot_correction_rad)), 8.81) << i;
    EXPECT_TRUE(laser.dist_correction_m >= 1.1 && laser.dist_correction_m <= 1.5) << i;
    EXPECT_TRUE(laser.vert_offset_m > 0.1 && laser.vert_offset_m < 0.22) << i;
    EXPECT_DOUBLE_EQ(std::abs(laser.horiz_offset_m), 0.026);
    EXPECT_TRUE(laser.two_point);
  }
}

TEST(NominalHdl64e, NumbersItsLasersOutOfTheirVerticalOrder) {
  const auto rows = rows_by_elevation(nominal_hdl64e());
  EXPECT_FALSE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_FALSE(std::is_sorted(rows.rbegin(), rows.rend()));
}

TEST(NominalHdl64e, RotationsSpreadOverManyColumns) {
  std::set<int> tenths;
  for (const Hdl64eLaser& laser : nominal_hdl64e().lasers) {
    tenths.insert(static_cast<int>(std::lround(beams::rad_to_deg(laser.rot_correction_rad))));
  }
  EXPECT_GE(tenths.size(), 8U);
}

}  // namespace
}  // namespace terracut::hdl64e
