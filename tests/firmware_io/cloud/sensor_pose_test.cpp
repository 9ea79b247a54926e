// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/sensor_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "calib/beams/angle.hpp"

namespace terracut::cloud {
namespace {

using beams::deg_to_rad;

struct NumberedCloud {
  std::vector<scan::ScanPoint> points;
  std::vector<std::uint16_t> laser;
};

/// A sensor of 16 lasers 1.8 m above the ground, in a square of walls 20 m away, in its own frame.
NumberedCloud cloud_of_sensor() {
  NumberedCloud cloud;
  for (int laser = 0; laser < 16; ++laser) {
    const double slope = std::tan(deg_to_rad(-15 + 2 * laser));
    for (int step = 0; step < 720; ++step) {
      const double azimuth_rad = 2 * std::numbers::pi * step / 720;
      const double x = std::cos(azimuth_rad), y = std::sin(azimuth_rad);
      const double wall_m = 20 / std::max(std::abs(x), std::abs(y));
      const double distance_m = slope < 0 ? std::min(wall_m, -1.8 / slope) : wall_m;
      cloud.points.push_back({static_cast<float>(distance_m * x),
                              static_cast<float>(distance_m * y),
                              static_cast<float>(distance_m * slope), 0});
      cloud.laser.push_back(static_cast<std::uint16_t>(laser));
    }
  }
  return cloud;
}

std::optional<mount::RigidTransform> pose_of(const CloudView& view) {
  return find_sensor_pose(1, [&](std::size_t) -> Expected<CloudView> { return view; });
}

/// The frame at `at_m`, turned by roll and pitch.
mount::RigidTransform frame(double roll_deg, double pitch_deg, const std::array<double, 3>& at_m) {
  mount::RigidTransform T = mount::T_vehicle_lidar(
      {.height_m = at_m[2], .roll_rad = deg_to_rad(roll_deg), .pitch_rad = deg_to_rad(pitch_deg)});
  T[3] = at_m[0];
  T[7] = at_m[1];
  return T;
}

TEST(SensorPose, IsFoundAmongPointsOfALevelledOrAVehiclesFrame) {
  for (const auto& T : {frame(0, 15, {0, 0, 0}), frame(-12, 8, {0, 0, 0}),
                        frame(0, 0, {1.4, 0, 1.7}), frame(3, -20, {-0.6, 0.3, 2.1})}) {
    NumberedCloud cloud = cloud_of_sensor();
    move_points(T, cloud.points);
    const auto found = pose_of({cloud.points, cloud.laser});
    ASSERT_TRUE(found);
    for (std::size_t i = 0; i < T.size(); ++i) {
      EXPECT_NEAR((*found)[i], T[i], i % 4 == 3 ? 0.02 : 0.002) << i;
    }
  }
}

TEST(SensorPose, IsFoundWithPointsOfOtherThingsAmongThem) {
  const mount::RigidTransform T = frame(0, 15, {1.4, 0, 1.7});
  NumberedCloud cloud = cloud_of_sensor();
  move_points(T, cloud.points);
  for (std::size_t i = 0; i < cloud.points.size(); i += 20) cloud.points[i].z_m += 2;
  const auto found = pose_of({cloud.points, cloud.laser});
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i < T.size(); ++i) EXPECT_NEAR((*found)[i], T[i], 0.05) << i;
}

TEST(SensorPose, IsNotFoundWhereThePointsDoNotNameTheirLasers) {
  NumberedCloud cloud = cloud_of_sensor();
  move_points(frame(0, 15, {0, 0, 0}), cloud.points);
  EXPECT_FALSE(pose_of({cloud.points}));
  EXPECT_FALSE(pose_of({cloud.points, std::vector<std::uint16_t>(cloud.points.size(), 3)}));
  EXPECT_FALSE(pose_of({}));
}

TEST(SensorPose, PointsThatAreNoReturnsStayWhereTheyAre) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<scan::ScanPoint> points{{0, 0, 0, 1}, {kNan, 1, 1, 1}, {1, 2, 3, 1}};
  move_points(frame(0, 0, {1, 1, 1}), points);
  EXPECT_EQ(points[0].x_m, 0);
  EXPECT_TRUE(std::isnan(points[1].x_m));
  EXPECT_EQ(points[1].y_m, 1);
  EXPECT_FLOAT_EQ(points[2].x_m, 2);
  EXPECT_FLOAT_EQ(points[2].z_m, 4);
}

}  // namespace
}  // namespace terracut::cloud
