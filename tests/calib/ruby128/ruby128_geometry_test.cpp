// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_geometry.hpp"

#include <cmath>
#include <random>

#include "calib/beams/angle.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::ruby128 {
namespace {

double range_m(const beams::Point& p) {
  return std::hypot(p.x_m, p.y_m, p.z_m);
}
double distance_m(const beams::Point& a, const beams::Point& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m);
}

/// The maker's formulas, written down once more.
beams::Point by_the_formula(const Ruby128Channel& channel, double azimuth_rad, double raw) {
  const double d = raw * 0.005;
  const double v = channel.elevation_rad, h = channel.azimuth_offset_rad;
  return {d * std::cos(v) * std::cos(azimuth_rad + h) + 0.03615 * std::cos(azimuth_rad),
          -d * std::cos(v) * std::sin(azimuth_rad + h) - 0.03615 * std::sin(azimuth_rad),
          d * std::sin(v)};
}

/// Random channels, azimuths and raw distances, the same each time.
template <class Check>
void for_random_firings(int count, Check check) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> channel(0, kRuby128Lasers - 1);
  std::uniform_real_distribution<double> azimuth(-7.0, 14.0), raw(2.0, 65000.0);
  for (int i = 0; i < count; ++i) check(channel(random), azimuth(random), raw(random));
}

TEST(Ruby128Geometry, PutsAPlainBeamWhereTheHandSaysItIs) {
  const Ruby128Geometry geometry(Ruby128Calibration{});     // level, straight ahead of the head
  const beams::Point ahead = geometry.point(0, 0.0, 2123);  // the manual's 10.615 m
  EXPECT_NEAR(ahead.x_m, 10.615 + 0.03615, 1e-12);
  EXPECT_NEAR(ahead.y_m, 0.0, 1e-12);
  EXPECT_NEAR(ahead.z_m, 0.0, 1e-12);
  const beams::Point right =
      geometry.point(127, beams::deg_to_rad(90), 2123);  // clockwise from above
  EXPECT_NEAR(right.x_m, 0.0, 1e-12);
  EXPECT_NEAR(right.y_m, -10.65115, 1e-12);
}

TEST(Ruby128Geometry, FollowsAHandComputedExample) {
  // t = 30 deg, h = 30 deg, v = -30 deg, d = 10 m; level part 8.660254 m at 60 deg, lens at 30 deg:
  // x = 4.330127 + 0.031307, y = -(7.5 + 0.018075), z = -5.
  Ruby128Calibration calibration;
  calibration.channels[9] = {beams::deg_to_rad(-30), beams::deg_to_rad(30)};
  const beams::Point p = Ruby128Geometry(calibration).point(9, beams::deg_to_rad(30), 2000);
  EXPECT_NEAR(p.x_m, 4.361434, 1e-6);
  EXPECT_NEAR(p.y_m, -7.518075, 1e-6);
  EXPECT_NEAR(p.z_m, -5.0, 1e-12);
}

TEST(Ruby128Geometry, PositiveAzimuthOffsetFramesTheBeamRight) {
  Ruby128Calibration calibration;
  calibration.channels[0].azimuth_offset_rad = beams::deg_to_rad(5.95);
  EXPECT_LT(Ruby128Geometry(calibration).point(0, 0.0, 5000).y_m, 0);
}

TEST(Ruby128Geometry, AgreesWithTheMakersFormulaEverywhere) {
  const Ruby128Calibration calibration = nominal_ruby128();
  const Ruby128Geometry geometry(calibration);
  for_random_firings(20000, [&](int channel, double azimuth, double raw) {
    const auto& angles = calibration.channels[static_cast<std::size_t>(channel)];
    ASSERT_LT(
        distance_m(geometry.point(channel, azimuth, raw), by_the_formula(angles, azimuth, raw)),
        1e-11);
  });
}

TEST(Ruby128Geometry, RayHoldsEveryPoint) {
  const Ruby128Geometry geometry(nominal_ruby128());
  for_random_firings(5000, [&](int channel, double azimuth, double raw) {
    const beams::Ray ray = geometry.ray(channel, azimuth);
    const double along_m = raw * 0.005;
    const beams::Point on_ray{ray.origin.x_m + along_m * ray.direction.x,
                              ray.origin.y_m + along_m * ray.direction.y,
                              ray.origin.z_m + along_m * ray.direction.z};
    ASSERT_LT(distance_m(geometry.point(channel, azimuth, raw), on_ray), 1e-10);
    ASSERT_NEAR(std::hypot(ray.direction.x, ray.direction.y, ray.direction.z), 1.0, 1e-12);
    ASSERT_NEAR(std::hypot(ray.origin.x_m, ray.origin.y_m), 0.03615, 1e-12);
    ASSERT_EQ(ray.origin.z_m, 0.0);
  });
}

TEST(Ruby128Geometry, RawForRangeInvertsRange) {
  const Ruby128Geometry geometry(nominal_ruby128());
  for_random_firings(20000, [&](int channel, double azimuth, double raw) {
    const double range = range_m(geometry.point(channel, azimuth, raw));
    const auto back = geometry.raw_for_range(channel, azimuth, range);
    ASSERT_TRUE(back.has_value());
    ASSERT_NEAR(*back, raw, 1e-6);
    ASSERT_NEAR(range_m(geometry.point(channel, azimuth, *back)), range, 1e-9);
  });
}

TEST(Ruby128Geometry, RawForRangeSaysWhereTheWireEnds) {
  const Ruby128Geometry geometry(nominal_ruby128());
  const auto whole = [&](double raw) { return range_m(geometry.point(7, 1.0, raw)); };
  EXPECT_TRUE(geometry.raw_for_range(7, 1.0, whole(1.001)).has_value());
  EXPECT_FALSE(geometry.raw_for_range(7, 1.0, whole(0.999)).has_value());
  EXPECT_TRUE(geometry.raw_for_range(7, 1.0, whole(65534.999)).has_value());
  EXPECT_FALSE(geometry.raw_for_range(7, 1.0, whole(65535.001)).has_value());
  for (const double nowhere : {0.0, 0.01, 400.0, std::nan(""), HUGE_VAL}) {
    EXPECT_FALSE(geometry.raw_for_range(7, 1.0, nowhere).has_value()) << nowhere;
  }
}

TEST(Ruby128Geometry, RawOnPlaneHitsThePlane) {
  const Ruby128Geometry geometry(nominal_ruby128());
  std::mt19937 random(4);
  std::normal_distribution<double> component;
  int hits = 0;
  for_random_firings(20000, [&](int channel, double azimuth, double raw) {
    const beams::Point hit = geometry.point(channel, azimuth, raw);
    const beams::Direction normal{3 * component(random), 3 * component(random),
                                  3 * component(random)};
    const double length = std::hypot(normal.x, normal.y, normal.z);
    const beams::Ray ray = geometry.ray(channel, azimuth);
    const double sine =
        (normal.x * ray.direction.x + normal.y * ray.direction.y + normal.z * ray.direction.z) /
        length;
    if (std::abs(sine) < 0.01) return;  // the crossing is too long to name one point of it
    const auto back = geometry.raw_on_plane(channel, azimuth, hit, normal);
    ASSERT_TRUE(back.has_value());
    ASSERT_NEAR(*back, raw, 1e-6);
    const beams::Point p = geometry.point(channel, azimuth, *back);
    ASSERT_NEAR(((p.x_m - hit.x_m) * normal.x + (p.y_m - hit.y_m) * normal.y +
                 (p.z_m - hit.z_m) * normal.z) /
                    length,
                0.0, 1e-9);
    ++hits;
  });
  EXPECT_GT(hits, 19000);
}

TEST(Ruby128Geometry, RawOnPlaneTakesAnyPointOfThePlane) {
  const Ruby128Geometry geometry(nominal_ruby128());
  // The lowest beam and a floor 2 m below: d = 2 / sin 25 deg.
  const auto raw = geometry.raw_on_plane(35, 2.0, {700.0, -300.0, -2.0}, {0, 0, 0.1});
  ASSERT_TRUE(raw.has_value());
  EXPECT_NEAR(*raw * 0.005, 2.0 / std::sin(beams::deg_to_rad(25)), 1e-9);
}

TEST(Ruby128Geometry, NoRawDistanceBehindTheLensAlongThePlaneOrBeyondTheWire) {
  const Ruby128Geometry geometry(nominal_ruby128());
  const beams::Direction up{0, 0, 1};
  EXPECT_FALSE(geometry.raw_on_plane(35, 0, {0, 0, 2}, up).has_value());  // looks down
  EXPECT_FALSE(geometry.raw_on_plane(35, 0, {5, 0, -200}, up).has_value());
  EXPECT_FALSE(geometry.raw_on_plane(35, 0, {5, 0, -2}, {0, 0, 0}).has_value());
  const Ruby128Geometry level(Ruby128Calibration{});
  EXPECT_FALSE(level.raw_on_plane(0, 0.7, {5, 0, 0}, up).has_value());
  EXPECT_FALSE(level.raw_on_plane(0, 0.7, {5, 0, -1}, up).has_value());
}

TEST(Ruby128Geometry, ABeamInThePlaneIsAlongItWhateverRoundingSays) {
  const Ruby128Geometry geometry(nominal_ruby128());
  for_random_firings(5000, [&](int channel, double azimuth, double raw) {
    const beams::Direction beam = geometry.ray(channel, azimuth).direction;
    // Two normals across the beam, one of them level.
    const beams::Direction level{-beam.y, beam.x, 0};
    const beams::Direction upward{-beam.z * beam.x, -beam.z * beam.y,
                                  beam.x * beam.x + beam.y * beam.y};
    const beams::Point hit = geometry.point(channel, azimuth, raw);
    ASSERT_FALSE(geometry.raw_on_plane(channel, azimuth, hit, level).has_value());
    ASSERT_FALSE(geometry.raw_on_plane(channel, azimuth, hit, upward).has_value());
  });
}

}  // namespace
}  // namespace terracut::ruby128
