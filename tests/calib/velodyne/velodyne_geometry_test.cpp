// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/velodyne/velodyne_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/beams/angle.hpp"

namespace terracut::velodyne {
namespace {

VelodyneCalibration one_laser(const VelodyneLaser& laser) {
  return {VelodyneModel::kVlp16, {laser}, "by hand"};
}

TEST(VelodyneGeometry, FollowsAHandComputedExample) {
  // t = 30 deg, h = 30 deg, v = -30 deg, d = 10 m, o = 0.1 m: level part 8.660254 m at 60 deg.
  const VelodyneGeometry geometry(one_laser({beams::deg_to_rad(-30), beams::deg_to_rad(30), 0.1}),
                                  0.004);
  const beams::Point p = geometry.point(0, beams::deg_to_rad(30), 2500);
  EXPECT_NEAR(p.x_m, 4.330127, 1e-6);
  EXPECT_NEAR(p.y_m, -7.5, 1e-6);
  EXPECT_NEAR(p.z_m, -4.9, 1e-12);
}

TEST(VelodyneGeometry, ChannelsBeyondTheLasersAreThemAgain) {
  const VelodyneGeometry geometry(factory_table(VelodyneModel::kVlp16), 0.002);
  for (int laser = 0; laser < 16; ++laser) {
    EXPECT_EQ(geometry.point(laser, 1.0, 4000).z_m, geometry.point(laser + 16, 1.0, 4000).z_m);
  }
}

TEST(VelodyneGeometry, CountsAreFoundAgainByRangeAndByPlane) {
  for (const VelodyneModel model : {VelodyneModel::kVlp16, VelodyneModel::kVls128}) {
    const VelodyneCalibration table = factory_table(model);
    const VelodyneGeometry geometry(table, 0.004);
    for (int laser = 0; laser < static_cast<int>(table.lasers.size()); ++laser) {
      const double azimuth_rad = 0.1 * laser, raw = 400 + 300 * laser;
      const beams::Point hit = geometry.point(laser, azimuth_rad, raw);
      const auto by_range =
          geometry.raw_for_range(laser, azimuth_rad, std::hypot(hit.x_m, hit.y_m, hit.z_m));
      const auto by_plane = geometry.raw_on_plane(laser, azimuth_rad, hit, {hit.x_m, hit.y_m, 3});
      ASSERT_TRUE(by_range && by_plane) << laser;
      EXPECT_NEAR(*by_range, raw, 1e-6);
      EXPECT_NEAR(*by_plane, raw, 1e-6);
    }
  }
}

TEST(VelodyneGeometry, NoCountsWhereTheWireOrTheBeamEnds) {
  const VelodyneGeometry geometry(one_laser({}), 0.002);
  EXPECT_FALSE(geometry.raw_for_range(0, 0, 0.001));
  EXPECT_FALSE(geometry.raw_for_range(0, 0, 132));
  EXPECT_FALSE(geometry.raw_on_plane(0, 0, {5, 0, -2}, {0, 0, 1}));  // along the plane
  EXPECT_FALSE(geometry.raw_on_plane(0, 0, {-5, 0, 0}, {1, 0, 0}));  // behind
}

TEST(VelodyneTable, WithOtherThanItsModelsLasersIsRefused) {
  EXPECT_TRUE(validate(factory_table(VelodyneModel::kVls128)));
  EXPECT_FALSE(validate(one_laser({})));
  VelodyneCalibration broken = factory_table(VelodyneModel::kVlp16);
  broken.lasers[3].elevation_rad = std::nan("");
  EXPECT_FALSE(validate(broken));
}

}  // namespace
}  // namespace terracut::velodyne
