// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/beams/straight_geometry.hpp"

#include <gtest/gtest.h>

#include <random>

#include "calib/beams/angle.hpp"
#include "calib/beams/beam_table.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"

namespace terracut::beams {
namespace {

StraightGeometry of_ruby(const ruby128::Ruby128Calibration& calibration) {
  return {calibration.channels, ruby128::kRuby128MetresPerCount, ruby128::kRuby128LensAhead_m};
}

double distance_m(const Point& a, const Point& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m);
}

/// Random lasers of 128, azimuths and raw distances, the same each time.
template <class Check>
void for_random_firings(int count, Check check) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> laser(0, 127);
  std::uniform_real_distribution<double> azimuth(-7.0, 14.0), raw(2.0, 65000.0);
  for (int i = 0; i < count; ++i) check(laser(random), azimuth(random), raw(random));
}

TEST(StraightGeometry, PutsAPlainBeamWhereTheHandSaysItIs) {
  const StraightGeometry level = of_ruby({});  // straight ahead of the head
  const Point ahead = level.point(0, 0.0, 2123);
  EXPECT_LT(distance_m(ahead, {10.615 + 0.03615, 0, 0}), 1e-12) << "the manual's 10.615 m";
  const Point right = level.point(127, deg_to_rad(90), 2123);
  EXPECT_LT(distance_m(right, {0, -10.65115, 0}), 1e-12) << "clockwise from above";
}

TEST(StraightGeometry, FollowsExamplesComputedByHand) {
  // t = 30 deg, h = 30 deg, v = -30 deg, d = 10 m; level part 8.660254 m at 60 deg.
  ruby128::Ruby128Calibration ruby;
  ruby.channels[9] = {deg_to_rad(-30), deg_to_rad(30)};
  // The lens at 30 deg: x = 4.330127 + 0.031307, y = -(7.5 + 0.018075).
  EXPECT_LT(distance_m(of_ruby(ruby).point(9, deg_to_rad(30), 2000), {4.361434, -7.518075, -5}),
            1e-6);
  const beams::BeamTable velodyne{
      sensor::SensorModel::kVlp16, {{deg_to_rad(-30), deg_to_rad(30), 0.1}}, "by hand"};
  EXPECT_LT(distance_m(StraightGeometry(velodyne.lasers, 0.004).point(0, deg_to_rad(30), 2500),
                       {4.330127, -7.5, -4.9}),
            1e-6);
}

TEST(StraightGeometry, AgreesWithTheMakersFormulaEverywhere) {
  const ruby128::Ruby128Calibration calibration = ruby128::nominal_ruby128();
  const StraightGeometry geometry = of_ruby(calibration);
  for_random_firings(20000, [&](int channel, double t, double raw) {
    const auto& angles = calibration.channels[static_cast<std::size_t>(channel)];
    const double d = raw * 0.005, v = angles.elevation_rad, h = angles.azimuth_offset_rad;
    const Point by_the_formula{d * std::cos(v) * std::cos(t + h) + 0.03615 * std::cos(t),
                               -d * std::cos(v) * std::sin(t + h) - 0.03615 * std::sin(t),
                               d * std::sin(v)};
    ASSERT_LT(distance_m(geometry.point(channel, t, raw), by_the_formula), 1e-11);
  });
}

TEST(StraightGeometry, LasersBeyondTheTableAreThemAgain) {
  const StraightGeometry geometry(beams::built_in_table(sensor::SensorModel::kVlp16).lasers, 0.002);
  for (int laser = 0; laser < 16; ++laser) {
    EXPECT_EQ(geometry.point(laser, 1.0, 4000).z_m, geometry.point(laser + 16, 1.0, 4000).z_m);
  }
}

TEST(StraightGeometry, RayHoldsEveryPoint) {
  const StraightGeometry geometry = of_ruby(ruby128::nominal_ruby128());
  for_random_firings(5000, [&](int channel, double azimuth, double raw) {
    const Ray ray = geometry.ray(channel, azimuth);
    const double along_m = raw * 0.005;
    const Point on_ray{ray.origin.x_m + along_m * ray.direction.x,
                       ray.origin.y_m + along_m * ray.direction.y,
                       ray.origin.z_m + along_m * ray.direction.z};
    ASSERT_LT(distance_m(geometry.point(channel, azimuth, raw), on_ray), 1e-10);
    ASSERT_NEAR(std::hypot(ray.direction.x, ray.direction.y, ray.direction.z), 1.0, 1e-12);
  });
}

TEST(StraightGeometry, RawOnPlaneHitsThePlane) {
  const auto vls128 = beams::built_in_table(sensor::SensorModel::kVls128);
  for (const StraightGeometry& geometry :
       {of_ruby(ruby128::nominal_ruby128()), StraightGeometry(vls128.lasers, 0.004)}) {
    std::mt19937 random(4);
    std::normal_distribution<double> component;
    int hits = 0;
    for_random_firings(20000, [&](int laser, double azimuth, double raw) {
      const Point hit = geometry.point(laser, azimuth, raw);
      const Direction normal{3 * component(random), 3 * component(random), 3 * component(random)};
      const Direction beam = geometry.ray(laser, azimuth).direction;
      const double sine = (normal.x * beam.x + normal.y * beam.y + normal.z * beam.z) /
                          std::hypot(normal.x, normal.y, normal.z);
      if (std::abs(sine) < 0.01) return;  // the crossing is too long to name one point of it
      const auto back = geometry.raw_on_plane(laser, azimuth, hit, normal);
      ASSERT_TRUE(back.has_value());
      ASSERT_NEAR(*back, raw, 1e-6);
      ++hits;
    });
    EXPECT_GT(hits, 19000);
  }
}

TEST(StraightGeometry, RawOnPlaneTakesAnyPointOfThePlane) {
  const StraightGeometry geometry = of_ruby(ruby128::nominal_ruby128());
  // The lowest beam and a floor 2 m below: d = 2 / sin 25 deg.
  const auto raw = geometry.raw_on_plane(35, 2.0, {700.0, -300.0, -2.0}, {0, 0, 0.1});
  ASSERT_TRUE(raw.has_value());
  EXPECT_NEAR(*raw * 0.005, 2.0 / std::sin(deg_to_rad(25)), 1e-9);
}

TEST(StraightGeometry, NoRawDistanceBehindTheLensAlongThePlaneOrBeyondTheWire) {
  const StraightGeometry geometry = of_ruby(ruby128::nominal_ruby128()), level = of_ruby({});
  const Direction up{0, 0, 1};
  EXPECT_FALSE(geometry.raw_on_plane(35, 0, {0, 0, 2}, up).has_value());  // looks down
  EXPECT_FALSE(geometry.raw_on_plane(35, 0, {5, 0, -200}, up).has_value());
  EXPECT_FALSE(geometry.raw_on_plane(35, 0, {5, 0, -2}, {0, 0, 0}).has_value());
  EXPECT_FALSE(level.raw_on_plane(0, 0.7, {5, 0, 0}, up).has_value());
  EXPECT_FALSE(level.raw_on_plane(0, 0.7, {5, 0, -1}, up).has_value());
}

TEST(StraightGeometry, ABeamInThePlaneIsAlongItWhateverRoundingSays) {
  const StraightGeometry geometry = of_ruby(ruby128::nominal_ruby128());
  for_random_firings(5000, [&](int channel, double azimuth, double raw) {
    const Direction beam = geometry.ray(channel, azimuth).direction;
    // Two normals across the beam, one of them level.
    const Direction level{-beam.y, beam.x, 0};
    const Direction upward{-beam.z * beam.x, -beam.z * beam.y, beam.x * beam.x + beam.y * beam.y};
    const Point hit = geometry.point(channel, azimuth, raw);
    ASSERT_FALSE(geometry.raw_on_plane(channel, azimuth, hit, level).has_value());
    ASSERT_FALSE(geometry.raw_on_plane(channel, azimuth, hit, upward).has_value());
  });
}

}  // namespace
}  // namespace terracut::beams
