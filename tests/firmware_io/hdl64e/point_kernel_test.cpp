// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/point_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "tests/support/places.hpp"

namespace terracut::hdl64e {
namespace {

/// Random raw distances at random azimuths through the kernel and through the double functions.
double worst_error_m(const Hdl64eCalibration& calibration, GeometryModel model,
                     const mount::Mount& mount) {
  const PointKernel kernel(calibration, model, mount);
  const Hdl64eGeometry geometry(calibration, model);
  const auto T = mount::T_vehicle_lidar(mount);
  memory::FixedMemory memory;
  const packet::RotorDirections directions(memory);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> any_raw(1, 65'535), near_raw(1, 3'000), any_cdeg(0, 35'999),
      any_step(2'000, 100'000);
  double worst_m = 0;
  for (int tile = 0; tile < 20; ++tile) {
    packet::GroupHeads<kLasersPerBlock> heads{};
    frame::TileRow<std::int32_t> azimuth_cdeg{}, step_ticks{};
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      azimuth_cdeg[f] = any_cdeg(random);
      step_ticks[f] = any_step(random);
      const packet::SinCos head = directions.at(azimuth_cdeg[f]);
      heads.sin_rotor[f] = head.sin;
      heads.cos_rotor[f] = head.cos;
      for (std::size_t group = 0; group < kLasersPerBlock; ++group) {
        const packet::SinCos advance =
            packet::small_advance(firing_advance_ticks(step_ticks[f], static_cast<int>(group)));
        heads.sin_advance[group][f] = advance.sin;
        heads.cos_advance[group][f] = advance.cos;
      }
    }
    for (int laser = 0; laser < kHdl64eLasers; ++laser) {
      const auto i = static_cast<std::size_t>(laser);
      frame::TileRow<std::uint16_t> raw{};
      for (auto& counts : raw) {
        counts = static_cast<std::uint16_t>(tile % 2 == 0 ? any_raw(random) : near_raw(random));
      }
      frame::TileRow<float> measured_m{};
      packet::measure(raw.data(), static_cast<float>(calibration.distance_resolution_m),
                      measured_m.data());
      frame::TilePoints points{};
      kernel.compute(i, packet::heads_of_group(heads, i % kLasersPerBlock), measured_m,
                     frame::all_of(points));
      for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
        const double azimuth_rad =
            packet::firing_azimuth_rad(azimuth_cdeg[f], firing_advance_ticks(step_ticks[f], laser));
        const auto p = geometry.point(laser, azimuth_rad, raw[f]);
        const auto v = mount::apply(T, p.x_m, p.y_m, p.z_m);
        const double allowed_m = 1e-6 * std::hypot(p.x_m, p.y_m, p.z_m);
        const double error_m =
            std::hypot(points.x_m[f] - v[0], points.y_m[f] - v[1], points.z_m[f] - v[2]);
        const double range_error_m = std::abs(points.ground_range_m[f] - std::hypot(v[0], v[1]));
        worst_m = std::max({worst_m, error_m - allowed_m, range_error_m - allowed_m});
      }
    }
  }
  return worst_m;
}

void expect_agreement(const Hdl64eCalibration& calibration) {
  for (const auto model : {GeometryModel::kManual, GeometryModel::kRosLike}) {
    const mount::Mount mount{.height_m = 1.73, .roll_rad = 0.03, .pitch_rad = -0.05};
    EXPECT_LT(worst_error_m(calibration, model, mount), 0.001) << calibration.origin;
  }
}

TEST(PointKernel, AgreesWithTheDoubleGeometryOnTheNominalUnit) {
  expect_agreement(nominal_hdl64e());
}

class RealUnit : public testing::TestWithParam<const char*> {};

TEST_P(RealUnit, AgreesWithTheDoubleGeometry) {
  const auto path = test::shared_data("calib") / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto calibration = load_hdl64e_calibration(path);
  ASSERT_TRUE(calibration) << calibration.error().message;
  expect_agreement(*calibration);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealUnit,
                         testing::Values("64e_s2.1-sztaki.xml", "64e_s3-xiesc.yaml",
                                         "64e_utexas.yaml", "calib-HDL-64E.xml", "db-ajaayc.xml"),
                         [](const auto& case_info) {
                           std::string name = case_info.param;
                           for (char& c : name) {
                             if (c == '.' || c == '-') c = '_';
                           }
                           return name;
                         });

TEST(PointKernel, TurnsClockwiseAndLeavesOutWhatWasNotMeasured) {
  const Hdl64eCalibration flat;
  const PointKernel kernel(flat, GeometryModel::kManual, {.height_m = 2.0});
  packet::GroupHeads<kLasersPerBlock> heads{};
  heads.sin_rotor.fill(1);  // clockwise: to the right, which is -y
  heads.cos_advance[0].fill(1);
  frame::TileRow<float> measured_m{20.0F, std::numeric_limits<float>::quiet_NaN()};
  frame::TilePoints points{};
  kernel.compute(0, packet::heads_of_group(heads, 0), measured_m, frame::all_of(points));
  EXPECT_NEAR(points.x_m[0], 0.0, 1e-5);
  EXPECT_NEAR(points.y_m[0], -20.0, 1e-5);
  EXPECT_NEAR(points.z_m[0], 2.0, 1e-6);
  EXPECT_NEAR(points.ground_range_m[0], 20.0, 1e-5);
  EXPECT_TRUE(std::isnan(points.z_m[1]));
}

}  // namespace
}  // namespace terracut::hdl64e
