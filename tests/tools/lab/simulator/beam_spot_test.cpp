// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/simulator/beam_spot.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace terracut::simulator {
namespace {

constexpr double kHalfWidth_rad = 1.25e-3;

const world::SightLine kLevel{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0.6, -0.8, 0)};

TEST(BeamSpot, FillsTheDiscOfLightAroundTheAxis) {
  double widest_rad = 0, sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kRays = 5000;
  for (std::uint64_t key = 0; key < kRays; ++key) {
    const SideLine side = side_line(kLevel, kHalfWidth_rad, key);
    EXPECT_EQ(side.line.origin, kLevel.origin);
    EXPECT_NEAR(side.line.direction.norm(), 1, 1e-12);
    EXPECT_GE(side.share, 0.25);
    EXPECT_LE(side.share, 1.0);
    const double off_rad = (side.line.direction - kLevel.direction).norm();
    widest_rad = std::max(widest_rad, off_rad);
    sum += off_rad * off_rad;
    mean += (side.line.direction - kLevel.direction) / kRays;
  }
  EXPECT_LE(widest_rad, kHalfWidth_rad);
  EXPECT_GT(widest_rad, 0.98 * kHalfWidth_rad);
  EXPECT_NEAR(sum / kRays, kHalfWidth_rad * kHalfWidth_rad / 2,
              0.03 * kHalfWidth_rad * kHalfWidth_rad);
  EXPECT_LT(mean.norm(), 0.05 * kHalfWidth_rad);
}

TEST(BeamSpot, IsTheSameForTheSameKeyOnly) {
  const SideLine once = side_line(kLevel, kHalfWidth_rad, 7);
  EXPECT_EQ(once.line.direction, side_line(kLevel, kHalfWidth_rad, 7).line.direction);
  EXPECT_EQ(once.ray_key, side_line(kLevel, kHalfWidth_rad, 7).ray_key);
  EXPECT_NE(once.line.direction, side_line(kLevel, kHalfWidth_rad, 8).line.direction);
  EXPECT_NE(once.ray_key, 7U);  // other leaves than those of the axis
}

world::Hit wall_at(double way_m, const Eigen::Vector3d& normal) {
  return {way_m, normal.normalized(), world::Truth::kBuilding, world::Material::kFacade};
}

TEST(BeamSpot, SurfacesBehindEachOtherGiveTwoEchoesWhenFarEnoughApart) {
  const Eigen::Vector3d facing = -kLevel.direction;
  EXPECT_FALSE(one_echo(kLevel, wall_at(20, facing), kLevel, wall_at(21, facing)));
  EXPECT_FALSE(one_echo(kLevel, wall_at(21, facing), kLevel, wall_at(20, facing)));
  EXPECT_TRUE(one_echo(kLevel, wall_at(20, facing), kLevel, wall_at(20.5, facing)));
}

TEST(BeamSpot, GroundSeenAtASlantIsOneEchoHoweverLong) {
  const Eigen::Vector3d up(0, 0, 1);
  const double down_rad = 1.73 / 60;
  const auto ray = [](double slope) {
    return world::SightLine{Eigen::Vector3d(0, 0, 1.73),
                            Eigen::Vector3d(1, 0, -slope).normalized()};
  };
  const world::SightLine axis = ray(down_rad), side = ray(down_rad - 1e-3);
  const auto ground = [&](const world::SightLine& line) {
    return world::Hit{-1.73 / line.direction.z(), up, world::Truth::kRoad,
                      world::Material::kAsphalt};
  };
  ASSERT_GT(ground(side).way_m - ground(axis).way_m, 1.5);
  EXPECT_TRUE(one_echo(axis, ground(axis), side, ground(side)));
}

}  // namespace
}  // namespace terracut::simulator
