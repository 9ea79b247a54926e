// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_geometry.hpp"

#include <cmath>
#include <random>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::hdl64e {
namespace {

double range_m(const beams::Point& p) {
  return std::hypot(p.x_m, p.y_m, p.z_m);
}
double distance_m(const beams::Point& a, const beams::Point& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m);
}

/// The formulas of the S3 manual's appendix F, written down once more in its own frame (X right, Y
/// forward, Z up) and turned to the sensor frame at the end.
beams::Point by_the_manual(const Hdl64eLaser& laser, double azimuth_rad, double raw) {
  const double a = azimuth_rad - laser.rot_correction_rad;
  const double d1 = raw * 0.002;
  const double omega = laser.vert_correction_rad;
  const double xy = (d1 + laser.dist_correction_m) * std::cos(omega);
  const double xx = std::fabs(xy * std::sin(a) - laser.horiz_offset_m * std::cos(a));
  const double yy = std::fabs(xy * std::cos(a) + laser.horiz_offset_m * std::sin(a));
  double cx = laser.dist_correction_m, cy = laser.dist_correction_m;
  if (laser.two_point && xx < 25.04) {
    cx = laser.dist_correction_x_m +
         (laser.dist_correction_m - laser.dist_correction_x_m) * (xx - 2.40) / (25.04 - 2.40);
  }
  if (laser.two_point && yy < 25.04) {
    cy = laser.dist_correction_y_m +
         (laser.dist_correction_m - laser.dist_correction_y_m) * (yy - 1.93) / (25.04 - 1.93);
  }
  const double X = (d1 + cx) * std::cos(omega) * std::sin(a) - laser.horiz_offset_m * std::cos(a);
  const double Y = (d1 + cy) * std::cos(omega) * std::cos(a) + laser.horiz_offset_m * std::sin(a);
  const double Z = (d1 + cy) * std::sin(omega) + laser.vert_offset_m;
  return {Y, -X, Z};
}

/// As ROS drivers compute it.
beams::Point as_ros_does(const Hdl64eLaser& laser, double azimuth_rad, double raw) {
  const double a = azimuth_rad - laser.rot_correction_rad;
  const double cv = std::cos(laser.vert_correction_rad), sv = std::sin(laser.vert_correction_rad);
  const double d = raw * 0.002 + laser.dist_correction_m;
  double xy = d * cv - laser.vert_offset_m * sv;
  const double xx = std::fabs(xy * std::sin(a) - laser.horiz_offset_m * std::cos(a));
  const double yy = std::fabs(xy * std::cos(a) + laser.horiz_offset_m * std::sin(a));
  double more_x = 0, more_y = 0;
  if (laser.two_point) {
    more_x = (laser.dist_correction_m - laser.dist_correction_x_m) * (xx - 2.4) / (25.04 - 2.4) +
             laser.dist_correction_x_m - laser.dist_correction_m;
    more_y = (laser.dist_correction_m - laser.dist_correction_y_m) * (yy - 1.93) / (25.04 - 1.93) +
             laser.dist_correction_y_m - laser.dist_correction_m;
  }
  xy = (d + more_x) * cv - laser.vert_offset_m * sv;
  const double x = xy * std::sin(a) - laser.horiz_offset_m * std::cos(a);
  xy = (d + more_y) * cv - laser.vert_offset_m * sv;
  const double y = xy * std::cos(a) + laser.horiz_offset_m * std::sin(a);
  return {y, -x, (d + more_y) * sv + laser.vert_offset_m * cv};
}

Hdl64eCalibration without_two_point() {
  Hdl64eCalibration calibration = nominal_hdl64e();
  for (Hdl64eLaser& laser : calibration.lasers) laser.two_point = false;
  return calibration;
}

/// Random lasers, azimuths and raw distances, the same each time.
template <class Check>
void for_random_firings(int count, Check check) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> laser(0, kHdl64eLasers - 1);
  std::uniform_real_distribution<double> azimuth(-7.0, 14.0), raw(100.0, 64000.0);
  for (int i = 0; i < count; ++i) check(laser(random), azimuth(random), raw(random));
}

TEST(Hdl64eGeometry, PutsAPlainBeamWhereTheHandSaysItIs) {
  Hdl64eCalibration calibration;  // no corrections at all
  const Hdl64eGeometry geometry(calibration);
  const beams::Point ahead = geometry.point(0, 0.0, 10000);  // 20 m
  EXPECT_NEAR(ahead.x_m, 20.0, 1e-12);
  EXPECT_NEAR(ahead.y_m, 0.0, 1e-12);
  const beams::Point right =
      geometry.point(0, beams::deg_to_rad(90), 10000);  // clockwise from above
  EXPECT_NEAR(right.x_m, 0.0, 1e-12);
  EXPECT_NEAR(right.y_m, -20.0, 1e-12);
}

TEST(Hdl64eGeometry, FollowsAHandComputedExample) {
  // a = 0 - (-30 deg) = 30 deg, omega = -30 deg, d1 = 8 m, D = 2 m, h = 0.02 m, v = 0.2 m:
  // xy = 10 cos 30 = 8.660254; right = xy / 2 - 0.02 cos 30 = 4.312806;
  // forward = xy cos 30 + 0.02 / 2 = 7.51; up = -10 / 2 + 0.2 = -4.8.
  Hdl64eCalibration calibration;
  calibration.lasers[9] = {.rot_correction_rad = beams::deg_to_rad(-30),
                           .vert_correction_rad = beams::deg_to_rad(-30),
                           .dist_correction_m = 2,
                           .vert_offset_m = 0.2,
                           .horiz_offset_m = 0.02};
  const beams::Point manual = Hdl64eGeometry(calibration).point(9, 0.0, 4000);
  EXPECT_NEAR(manual.x_m, 7.51, 1e-9);
  EXPECT_NEAR(manual.y_m, -4.312806, 1e-6);
  EXPECT_NEAR(manual.z_m, -4.8, 1e-9);
  // The other model: xy = 8.660254 + 0.2 / 2 = 8.760254; up = -5 + 0.2 cos 30 = -4.826795.
  const beams::Point ros = Hdl64eGeometry(calibration, GeometryModel::kRosLike).point(9, 0.0, 4000);
  EXPECT_NEAR(ros.x_m, 8.760254 * 0.8660254 + 0.01, 1e-6);
  EXPECT_NEAR(ros.y_m, -(8.760254 / 2 - 0.0173205), 1e-6);
  EXPECT_NEAR(ros.z_m, -4.826795, 1e-6);
}

TEST(Hdl64eGeometry, PositiveRotationalCorrectionTurnsTheBeamLeft) {
  Hdl64eCalibration calibration;
  calibration.lasers[0].rot_correction_rad = beams::deg_to_rad(5);
  EXPECT_GT(Hdl64eGeometry(calibration).point(0, 0.0, 5000).y_m, 0);
}

TEST(Hdl64eGeometry, AgreesWithTheManualsFormulasEverywhere) {
  const Hdl64eCalibration calibration = nominal_hdl64e();
  const Hdl64eGeometry geometry(calibration);
  for_random_firings(20000, [&](int laser, double azimuth, double raw) {
    const auto& row = calibration.lasers[static_cast<std::size_t>(laser)];
    ASSERT_LT(distance_m(geometry.point(laser, azimuth, raw), by_the_manual(row, azimuth, raw)),
              1e-11);
  });
}

TEST(Hdl64eGeometry, RosLikeAgreesWithWhatRosDriversCompute) {
  const Hdl64eCalibration calibration = nominal_hdl64e();
  const Hdl64eGeometry geometry(calibration, GeometryModel::kRosLike);
  for_random_firings(20000, [&](int laser, double azimuth, double raw) {
    const auto& row = calibration.lasers[static_cast<std::size_t>(laser)];
    ASSERT_LT(distance_m(geometry.point(laser, azimuth, raw), as_ros_does(row, azimuth, raw)),
              1e-11);
  });
}

TEST(Hdl64eGeometry, TheModelsDifferByTheVerticalOffsetAcrossTheBeam) {
  // v = 0.2 m at -24 deg: v sin = 8.1 cm outwards, v (1 - cos) = 1.7 cm down.
  Hdl64eCalibration calibration;
  calibration.lasers[0].vert_correction_rad = beams::deg_to_rad(-24);
  calibration.lasers[0].vert_offset_m = 0.2;
  const beams::Point manual = Hdl64eGeometry(calibration).point(0, 0, 2000);
  const beams::Point ros = Hdl64eGeometry(calibration, GeometryModel::kRosLike).point(0, 0, 2000);
  EXPECT_NEAR(ros.x_m - manual.x_m, 0.0813, 0.0001);
  EXPECT_NEAR(ros.z_m - manual.z_m, -0.0173, 0.0001);
}

TEST(Hdl64eGeometry, BeyondTheFarPointOnlyTheManualEndsTheInterpolation) {
  Hdl64eCalibration calibration;
  calibration.lasers[0] = {.dist_correction_m = 1.3,
                           .dist_correction_x_m = 1.35,
                           .dist_correction_y_m = 1.25,
                           .two_point = true};
  const double raw = 30000;  // 60 m
  EXPECT_NEAR(Hdl64eGeometry(calibration).point(0, 0, raw).x_m, 61.3, 1e-12);
  const double extrapolated = 60 + 1.25 + 0.05 * (61.3 - 1.93) / (25.04 - 1.93);
  EXPECT_NEAR(Hdl64eGeometry(calibration, GeometryModel::kRosLike).point(0, 0, raw).x_m,
              extrapolated, 1e-9);
}

TEST(Hdl64eGeometry, RangeGrowsWithRawDistanceWithoutAJump) {
  for (const GeometryModel model : {GeometryModel::kManual, GeometryModel::kRosLike}) {
    const Hdl64eGeometry geometry(nominal_hdl64e(), model);
    for (int laser = 0; laser < kHdl64eLasers; laser += 7) {
      for (const double azimuth : {0.0, 0.4, 0.8, 1.6, 3.9}) {
        double before = range_m(geometry.point(laser, azimuth, 0));
        for (int raw = 1; raw < 20000; ++raw) {
          const double now = range_m(geometry.point(laser, azimuth, raw));
          ASSERT_NEAR(now - before, 0.002, 0.0005) << laser << " " << azimuth << " " << raw;
          before = now;
        }
      }
    }
  }
}

TEST(Hdl64eGeometry, RayHoldsEveryPointOfALaserWithoutTwoPoint) {
  for (const GeometryModel model : {GeometryModel::kManual, GeometryModel::kRosLike}) {
    const Hdl64eCalibration calibration = without_two_point();
    const Hdl64eGeometry geometry(calibration, model);
    for_random_firings(5000, [&](int laser, double azimuth, double raw) {
      const beams::Ray ray = geometry.ray(laser, azimuth);
      const double along =
          raw * 0.002 + calibration.lasers[static_cast<std::size_t>(laser)].dist_correction_m;
      const beams::Point on_ray{ray.origin.x_m + along * ray.direction.x,
                                ray.origin.y_m + along * ray.direction.y,
                                ray.origin.z_m + along * ray.direction.z};
      ASSERT_LT(distance_m(geometry.point(laser, azimuth, raw), on_ray), 1e-10);
      ASSERT_NEAR(std::hypot(ray.direction.x, ray.direction.y, ray.direction.z), 1.0, 1e-12);
    });
  }
}

TEST(Hdl64eGeometry, RawForRangeInvertsRange) {
  for (const GeometryModel model : {GeometryModel::kManual, GeometryModel::kRosLike}) {
    const Hdl64eGeometry geometry(nominal_hdl64e(), model);
    for_random_firings(20000, [&](int laser, double azimuth, double raw) {
      const double range = range_m(geometry.point(laser, azimuth, raw));
      const auto found = geometry.raw_for_range(laser, azimuth, range);
      ASSERT_TRUE(found.has_value());
      ASSERT_NEAR(*found, raw, 1e-5);
    });
  }
}

TEST(Hdl64eGeometry, RoundedRawCountsMissARangeByLessThanOneAndAHalfMillimetres) {
  const Hdl64eGeometry geometry(nominal_hdl64e());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> range(2.0, 120.0), azimuth(0.0, 6.28);
  for (int i = 0; i < 20000; ++i) {
    const double wanted = range(random), at = azimuth(random);
    const auto raw = geometry.raw_for_range(i % kHdl64eLasers, at, wanted);
    ASSERT_TRUE(raw.has_value());
    ASSERT_NEAR(range_m(geometry.point(i % kHdl64eLasers, at, std::round(*raw))), wanted, 0.0015);
  }
}

TEST(Hdl64eGeometry, RangesTheWireCannotCarryHaveNoRaw) {
  const Hdl64eGeometry geometry(nominal_hdl64e());
  EXPECT_FALSE(geometry.raw_for_range(0, 0, 0.5));  // nearer than the correction itself
  EXPECT_FALSE(geometry.raw_for_range(0, 0, 140));  // 65535 * 2 mm + 1.1 m = 132.2 m
  EXPECT_FALSE(geometry.raw_for_range(0, 0, -5));
  EXPECT_FALSE(geometry.raw_for_range(0, 0, std::nan("")));
  EXPECT_FALSE(geometry.raw_for_range(0, 0, HUGE_VAL));
  EXPECT_TRUE(geometry.raw_for_range(0, 0, 130));
}

TEST(Hdl64eGeometry, RawOnPlanePutsThePointOnThePlane) {
  for (const GeometryModel model : {GeometryModel::kManual, GeometryModel::kRosLike}) {
    const Hdl64eGeometry geometry(nominal_hdl64e(), model);
    int found = 0;
    for_random_firings(20000, [&](int laser, double azimuth, double raw) {
      const beams::Ray ray = geometry.ray(laser, azimuth);
      const double along = 2.0 + raw * 0.001;
      const beams::Point hit{ray.origin.x_m + along * ray.direction.x,
                             ray.origin.y_m + along * ray.direction.y,
                             ray.origin.z_m + along * ray.direction.z};
      const beams::Direction normal{0.3 * ray.direction.x - 0.1, 0.3 * ray.direction.y,
                                    0.3 * ray.direction.z + 2.0};
      const double incidence =
          ray.direction.x * normal.x + ray.direction.y * normal.y + ray.direction.z * normal.z;
      if (std::abs(incidence) < 0.1) return;
      const auto counts = geometry.raw_on_plane(laser, azimuth, hit, normal);
      ASSERT_TRUE(counts.has_value());
      const beams::Point p = geometry.point(laser, azimuth, *counts);
      const double off = (p.x_m - hit.x_m) * normal.x + (p.y_m - hit.y_m) * normal.y +
                         (p.z_m - hit.z_m) * normal.z;
      ASSERT_LT(std::abs(off), 1e-8);
      ASSERT_LT(distance_m(p, hit), 0.6);  // two-point bends the beam by centimetres only
      ++found;
    });
    EXPECT_GT(found, 10000);
  }
}

TEST(Hdl64eGeometry, RawOnPlaneIsTheSameHoweverLongTheNormal) {
  const Hdl64eGeometry geometry(nominal_hdl64e());
  beams::Point hit = geometry.point(40, 0.2, 5000);
  hit.z_m += 0.2;  // the first guess is near, but off the plane
  const auto counts = geometry.raw_on_plane(40, 0.2, hit, {0, 0, 1});
  ASSERT_TRUE(counts.has_value());
  for (const double length : {1e-9, 1e9}) {
    const auto same = geometry.raw_on_plane(40, 0.2, hit, {0, 0, length});
    ASSERT_TRUE(same.has_value()) << length;
    EXPECT_NEAR(*same, *counts, 1e-5) << length;
  }
}

TEST(Hdl64eGeometry, ABeamAlongThePlaneHasNoRaw) {
  const Hdl64eGeometry geometry(without_two_point());
  const beams::Ray ray = geometry.ray(0, 0.3);
  const beams::Direction across{ray.direction.y, -ray.direction.x, 0};
  const beams::Point beside{ray.origin.x_m + across.x, ray.origin.y_m + across.y, ray.origin.z_m};
  EXPECT_FALSE(geometry.raw_on_plane(0, 0.3, beside, across));
  EXPECT_FALSE(geometry.raw_on_plane(0, 0.3, beside, {0, 0, 0}));
}

TEST(Hdl64eGeometry, InverseHoldsOnRealCalibrations) {
  for (const char* file : {"64e_s2.1-sztaki.xml", "64e_s3-xiesc.yaml", "64e_utexas.yaml"}) {
    const auto path = test::shared_data(std::string("calib/") + file);
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const auto calibration = load_hdl64e_calibration(path);
    ASSERT_TRUE(calibration.has_value());
    const Hdl64eGeometry geometry(*calibration);
    for_random_firings(5000, [&](int laser, double azimuth, double raw) {
      const beams::Point p = geometry.point(laser, azimuth, raw);
      ASSERT_LT(distance_m(p, by_the_manual(calibration->lasers[static_cast<std::size_t>(laser)],
                                            azimuth, raw)),
                1e-11);
      if (range_m(p) < 1.0) return;  // the sensor measures from 0.9 m on
      const auto found = geometry.raw_for_range(laser, azimuth, range_m(p));
      ASSERT_TRUE(found.has_value());
      ASSERT_NEAR(*found, raw, 1e-5);
    });
  }
}

}  // namespace
}  // namespace terracut::hdl64e
