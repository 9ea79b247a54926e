// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/planar_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace terracut::vehicle {
namespace {

void expect_near(const PlanarPose& a, const PlanarPose& b, double allowed) {
  EXPECT_NEAR(a.x_m, b.x_m, allowed);
  EXPECT_NEAR(a.y_m, b.y_m, allowed);
  EXPECT_NEAR(a.cosine, b.cosine, allowed);
  EXPECT_NEAR(a.sine, b.sine, allowed);
}

TEST(PlanarPose, APoseAndItsInverseCancel) {
  const PlanarPose pose{3, -4, std::cos(0.7), std::sin(0.7)};
  expect_near(pose * inverse(pose), {}, 1e-15);
  expect_near(inverse(pose) * pose, {}, 1e-15);
}

TEST(PlanarPose, ConstantMotionIsAnArcOfTheRadiusSpeedByYawRate) {
  for (const double yaw_rate_radps : {0.5, -0.5, 0.013, 3.0, -9.0}) {
    for (const double seconds : {0.01, 0.1, 1.0, -0.1}) {
      const double radius_m = 20 / yaw_rate_radps, rotated_rad = yaw_rate_radps * seconds;
      expect_near(after_constant_motion(20, yaw_rate_radps, seconds),
                  {radius_m * std::sin(rotated_rad), radius_m * (1 - std::cos(rotated_rad)),
                   std::cos(rotated_rad), std::sin(rotated_rad)},
                  1e-9);
    }
  }
}

TEST(PlanarPose, AnArcIsAsExactAsIsSaidAtItsLongest) {
  // 1 m of way, rotated by almost what is still computed as one arc.
  const double rotated_rad = 0.2499999, radius_m = 1 / rotated_rad;
  const double half_sine = std::sin(rotated_rad / 2);  // 1 - cos(x) = 2 sin(x / 2)^2, without loss
  expect_near(after_constant_motion(1, rotated_rad, 1),
              {radius_m * std::sin(rotated_rad), radius_m * 2 * half_sine * half_sine,
               std::cos(rotated_rad), std::sin(rotated_rad)},
              1e-11);
}

TEST(PlanarPose, WithoutYawTheWayIsStraight) {
  expect_near(after_constant_motion(20, 0, 0.1), {2, 0, 1, 0}, 1e-15);
  expect_near(after_constant_motion(-20, 0, 0.1), {-2, 0, 1, 0}, 1e-15);
}

TEST(PlanarPose, AVehicleThatStandsStillIsLeftExactlyWhereItIs) {
  const PlanarPose pose = after_constant_motion(0, 0, 0.1);
  EXPECT_EQ(pose.x_m, 0);
  EXPECT_EQ(pose.y_m, 0);
  EXPECT_EQ(pose.cosine, 1);
  EXPECT_EQ(pose.sine, 0);
}

TEST(PlanarPose, MotionBackFollowsTheSameArc) {
  const PlanarPose there = after_constant_motion(12, 0.8, 0.3);
  expect_near(there * after_constant_motion(12, 0.8, -0.3), {}, 1e-9);
}

}  // namespace
}  // namespace terracut::vehicle
