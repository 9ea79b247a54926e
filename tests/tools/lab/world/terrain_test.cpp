// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/world/terrain.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tools/lab/world/random.hpp"

namespace terracut::world {
namespace {

using Eigen::Vector3d;

constexpr double kKerb_m = 0.15;

/// 4 m of level road, a kerb, 2 m of level pavement, grass; the same on both sides.
Road kerbed_road() {
  Road road;
  road.left.strips = {
      {4, 0, 0, 0, Truth::kRoad, Material::kAsphalt},
      {2, kKerb_m, 0, 0, Truth::kSidewalk, Material::kPaving},
      {1, 0, 0.1, 0, Truth::kTerrain, Material::kGrass},
  };
  road.right = road.left;
  return road;
}

SightLine towards(const Vector3d& from, const Vector3d& to) {
  return {from, (to - from).normalized()};
}

TEST(Terrain, KerbRisesByItsHeightWithinAMillimetre) {
  const Terrain terrain(kerbed_road(), 1);
  EXPECT_NEAR(terrain.height_m(3, 3.9995), 0, 1e-12);
  EXPECT_NEAR(terrain.height_m(3, 4.0005), kKerb_m, 1e-12);
  EXPECT_NEAR(terrain.height_m(3, -4.0005), kKerb_m, 1e-12);
  EXPECT_NEAR(terrain.height_m(3, 8), kKerb_m + 0.2, 1e-12);
}

TEST(Terrain, KerbIsLowWhereItIsDropped) {
  Road road = kerbed_road();
  road.left.dropped_every_m = 30;
  road.left.dropped_at_m = 10;
  road.left.dropped_share = 1.0 / 3;
  const Terrain terrain(road, 1);
  EXPECT_NEAR(terrain.height_m(10, 5), 0.05, 1e-12);
  EXPECT_NEAR(terrain.height_m(40, 5), 0.05, 1e-12);
  EXPECT_NEAR(terrain.height_m(20, 5), kKerb_m, 1e-12);
}

TEST(Terrain, LineThatRunsAgainstAKerbStopsAtItsFace) {
  const Terrain terrain(kerbed_road(), 1);
  const SightLine line = towards({0, 0, 0.6}, {0.5, 4, 0.07});
  const auto hit = terrain.cast(line, 50);
  ASSERT_TRUE(hit);
  EXPECT_TRUE(line.at(hit->way_m).isApprox(Vector3d(0.5, 4, 0.07), 1e-4));
  EXPECT_EQ(hit->truth, Truth::kSidewalk);
  EXPECT_TRUE(hit->normal.isApprox(-Vector3d::UnitY()));
}

TEST(Terrain, LineOverAKerbMeetsThePavement) {
  const Terrain terrain(kerbed_road(), 1);
  const SightLine line = towards({0, 0, 1.7}, {0, 5, kKerb_m});
  const auto hit = terrain.cast(line, 50);
  ASSERT_TRUE(hit);
  EXPECT_TRUE(line.at(hit->way_m).isApprox(Vector3d(0, 5, kKerb_m), 1e-7));
  EXPECT_EQ(hit->truth, Truth::kSidewalk);
  EXPECT_TRUE(hit->normal.isApprox(Vector3d::UnitZ(), 1e-9));
}

TEST(Terrain, LineDownFromThePavementMeetsTheRoad) {
  const Terrain terrain(kerbed_road(), 1);
  const SightLine line = towards({0, 5, 0.5}, {0, 2, 0});
  const auto hit = terrain.cast(line, 50);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(line.at(hit->way_m).z(), 0, 1e-7);
  EXPECT_EQ(hit->truth, Truth::kRoad);
}

TEST(Terrain, GroundBeyondTheLimitIsNotMet) {
  const Terrain terrain(kerbed_road(), 1);
  const SightLine line = towards({0, 0, 1.0}, {100, 0, 0});
  EXPECT_TRUE(terrain.cast(line, 101));
  EXPECT_FALSE(terrain.cast(line, 99));
}

TEST(Terrain, UpwardLineMeetsNothingOverLevelGround) {
  const Terrain terrain(kerbed_road(), 1);
  EXPECT_FALSE(terrain.cast(towards({0, 0, 1.7}, {1, 0, 1.8}), 120));
}

/// Bends, grades, kerbs, ditches and bumps all at once.
Road rough_road() {
  Road road = kerbed_road();
  road.bend_m = 6;
  road.bend_length_m = 300;
  const std::array<GradeProfile::Knot, 3> knots = {{{-60, -0.06}, {0, 0.1}, {60, -0.06}}};
  road.grade = GradeProfile(knots);
  road.left.dropped_every_m = 20;
  road.left.dropped_share = 0.4;
  road.right.strips = {
      {3, 0, -0.03, 0.01, Truth::kRoad, Material::kAsphalt},
      {1.5, 0, -0.3, 0.05, Truth::kTerrain, Material::kGrass},
      {1.5, 0, 0.35, 0.05, Truth::kTerrain, Material::kGrass},
      {1, 0, 0.02, 0.15, Truth::kTerrain, Material::kGrass},
  };
  return road;
}

TEST(Terrain, FindsTheSameGroundAsTinyStepsDo) {
  const Terrain terrain(rough_road(), 5);
  Random random(3);
  int grazed = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x_m = random.uniform(-40, 40);
    const double y_m = terrain.road().y_m({x_m, random.uniform(-2, 2)});
    const double azimuth_rad = random.uniform(0, 2 * std::numbers::pi);
    const double fall = random.uniform(0.03, 0.45);
    const SightLine line{
        Vector3d(x_m, y_m, terrain.height_m(x_m, y_m) + 1.73),
        Vector3d(std::cos(azimuth_rad), std::sin(azimuth_rad), -fall).normalized()};
    constexpr double kLimit_m = 60;
    const auto hit = terrain.cast(line, kLimit_m);
    double found_m = kLimit_m;
    for (double way_m = 0; way_m < kLimit_m; way_m += 0.005) {
      const Vector3d at = line.at(way_m);
      if (at.z() < terrain.height_m(at.x(), at.y())) {
        found_m = way_m;
        break;
      }
    }
    const double cast_m = hit ? hit->way_m : kLimit_m;
    if (std::abs(cast_m - found_m) > 0.006) ++grazed;
    if (hit) {
      const Vector3d at = line.at(cast_m);
      EXPECT_NEAR(hit->normal.norm(), 1, 1e-9);
      const bool face = std::abs(hit->normal.z()) < 1e-9;
      if (!face) {
        EXPECT_NEAR(at.z(), terrain.height_m(at.x(), at.y()), 1e-6);
      }
    }
  }
  EXPECT_LE(grazed, 4);  // Bumps touched for centimetres may be missed.
}

TEST(Terrain, VehicleStandsAlongTheSlope) {
  Road road;
  const std::array<GradeProfile::Knot, 1> knots = {{{0, 0.15}}};
  road.grade = GradeProfile(knots);
  road.left.strips = {{10, 0, 0.02, 0, Truth::kRoad, Material::kAsphalt}};
  road.right.strips = {{10, 0, -0.02, 0, Truth::kRoad, Material::kAsphalt}};
  const Eigen::Isometry3d pose = stand_on(Terrain(road, 1), 20, 0, 0, 1.3, 0.8);
  const Vector3d ahead = pose.linear() * Vector3d::UnitX();
  const Vector3d left = pose.linear() * Vector3d::UnitY();
  EXPECT_NEAR(pose.translation().z(), 3.0, 1e-9);
  EXPECT_NEAR(ahead.z() / ahead.x(), 0.15, 1e-9);
  EXPECT_GT(left.z(), 0.015);
  EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace terracut::world
