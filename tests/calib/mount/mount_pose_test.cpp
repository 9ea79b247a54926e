// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_pose.hpp"

#include <gtest/gtest.h>

namespace terracut::mount {
namespace {

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// p + 2 w (v x p) + 2 v x (v x p) + translation.
std::array<double, 3> moved_by(const Pose& pose, const std::array<double, 3>& p) {
  const auto& q = pose.rotation_xyzw;
  const std::array<double, 3> v{q[0], q[1], q[2]};
  const auto once = cross(v, p), twice = cross(v, once);
  std::array<double, 3> moved{};
  for (std::size_t i = 0; i < 3; ++i) {
    moved[i] = p[i] + 2 * q[3] * once[i] + 2 * twice[i] + pose.translation_m[i];
  }
  return moved;
}

TEST(MountPose, TakesAPointBackToTheSensorFromWhichTheMountTookIt) {
  const Mount mount{.height_m = 1.9, .roll_rad = 0.05, .pitch_rad = -0.12};
  const std::array<double, 3> seen{3, -4, 0.5};
  const auto in_vehicle = mount::apply(T_vehicle_lidar(mount), seen[0], seen[1], seen[2]);
  const auto back = moved_by(vehicle_in_lidar(mount), in_vehicle);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back[i], seen[i], 1e-12);
}

TEST(MountPose, AnInverseTakesAPointBackAsThePoseDoes) {
  const Mount mount{.height_m = 1.9, .roll_rad = 0.05, .pitch_rad = -0.12};
  const RigidTransform back = inverse(T_vehicle_lidar(mount));
  const auto taken = mount::apply(back, 3, -4, 0.5);
  const auto expected = moved_by(vehicle_in_lidar(mount), {3, -4, 0.5});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(taken[i], expected[i], 1e-12);
}

TEST(MountPose, OfALevelSensorIsTheGroundBelowIt) {
  const Pose pose = vehicle_in_lidar({.height_m = 1.73, .roll_rad = 0, .pitch_rad = 0});
  EXPECT_DOUBLE_EQ(pose.translation_m[2], -1.73);
  EXPECT_DOUBLE_EQ(pose.rotation_xyzw[3], 1);
}

}  // namespace
}  // namespace terracut::mount
