// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/point_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "tests/support/places.hpp"

namespace terracut::hdl64e {
namespace {

constexpr std::size_t kLasers = PointKernel::kLasers;

struct Worst {
  double error_m = 0;  ///< Beyond 1e-6 of the range.
  int wrong_columns = 0;
};

/// Random raw distances at random azimuths through the kernel and through the double functions.
Worst compare(const Hdl64eCalibration& calibration, GeometryModel model,
              const mount::Mount& mount) {
  memory::FixedMemory memory;
  constexpr int kColumns = 2083;
  PointKernel kernel(calibration, model, mount, kColumns, memory);
  const Hdl64eGeometry geometry(calibration, model);
  const auto T = mount::T_vehicle_lidar(mount);
  const BeamOffsets beam_offsets(calibration);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> any_raw(1, 65'535), near_raw(1, 3'000), any_cdeg(0, 35'999),
      any_step(2'000, 100'000);
  Worst worst;
  for (int packet = 0; packet < 400; ++packet) {
    const std::int32_t step_ticks = any_step(random);
    std::array<std::int32_t, 32> advance{};
    std::array<std::int32_t, 64> offset{};
    for (int i = 0; i < 64; ++i) {
      advance[static_cast<std::size_t>(i % 32)] = firing_advance_ticks(step_ticks, i);
      offset[static_cast<std::size_t>(i)] = beam_offsets.offset_ticks(step_ticks, i);
    }
    kernel.begin_packet(advance, offset);
    decode::ColumnReturns<kLasers> column{};
    const std::int32_t azimuth_cdeg =
        packet % 4 == 0 ? (35'950 + packet / 4) % 36'000 : any_cdeg(random);
    for (auto& raw : column.raw) {
      raw = static_cast<std::uint16_t>(packet % 2 == 0 ? any_raw(random) : near_raw(random));
    }
    kernel.compute(azimuth_cdeg, column);
    for (std::size_t i = 0; i < kLasers; ++i) {
      const auto p =
          geometry.point(static_cast<int>(i),
                         decode::firing_azimuth_rad(azimuth_cdeg, advance[i % 32]), column.raw[i]);
      const auto v = mount::apply(T, p.x_m, p.y_m, p.z_m);
      const double range_m = std::hypot(p.x_m, p.y_m, p.z_m);
      const double error_m =
          std::hypot(column.x_m[i] - v[0], column.y_m[i] - v[1], column.z_m[i] - v[2]);
      const double range_error_m = std::abs(column.ground_range_m[i] - std::hypot(v[0], v[1]));
      worst.error_m =
          std::max({worst.error_m, error_m - 1e-6 * range_m, range_error_m - 1e-6 * range_m});
      const decode::BeamAzimuth beam = decode::beam_azimuth(azimuth_cdeg, offset[i]);
      worst.wrong_columns += column.frame_offset[i] != beam.frame;
      worst.wrong_columns +=
          column.column[i] != decode::column_of(beam.in_revolution_ticks, kColumns);
    }
  }
  return worst;
}

void expect_agreement(const Hdl64eCalibration& calibration) {
  for (const auto model : {GeometryModel::kManual, GeometryModel::kRosLike}) {
    const Worst worst =
        compare(calibration, model, {.height_m = 1.73, .roll_rad = 0.03, .pitch_rad = -0.05});
    EXPECT_LT(worst.error_m, 0.001) << calibration.origin;
    EXPECT_EQ(worst.wrong_columns, 0);
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

TEST(PointKernel, FindsTheColumnThatColumnOfFinds) {
  // Every tick around every column boundary of some image widths, on a unit without offsets.
  Hdl64eCalibration flat;
  for (const int columns : {16, 1800, 2083, 4167, 36'000}) {
    memory::FixedMemory memory;
    PointKernel kernel(flat, GeometryModel::kManual, {}, columns, memory);
    int wrong = 0;
    for (int boundary = 0; boundary <= columns; ++boundary) {
      const std::int64_t ticks = std::int64_t{boundary} * decode::kRevolution_ticks / columns;
      const auto cdeg = static_cast<std::int32_t>(std::min<std::int64_t>(ticks / 1000, 35'999));
      std::array<std::int32_t, 64> offset{};
      for (int i = 0; i < 64; ++i) {
        offset[static_cast<std::size_t>(i)] =
            static_cast<std::int32_t>(ticks - cdeg * 1000) + i - 32;
      }
      kernel.begin_packet(std::array<std::int32_t, 32>{}, offset);
      decode::ColumnReturns<kLasers> out{};
      kernel.compute(cdeg, out);
      for (std::size_t i = 0; i < kLasers; ++i) {
        const decode::BeamAzimuth beam = decode::beam_azimuth(cdeg, offset[i]);
        wrong += out.frame_offset[i] != beam.frame;
        wrong += out.column[i] != decode::column_of(beam.in_revolution_ticks, columns);
      }
    }
    EXPECT_EQ(wrong, 0) << columns;
  }
}

TEST(PointKernel, ReadsTwentyMetresFromTenThousandCounts) {
  Hdl64eCalibration flat;
  memory::FixedMemory memory;
  PointKernel kernel(flat, GeometryModel::kManual, {.height_m = 2.0}, 2083, memory);
  kernel.begin_packet(std::array<std::int32_t, 32>{}, std::array<std::int32_t, 64>{});
  decode::ColumnReturns<kLasers> out{};
  out.raw.fill(10'000);
  kernel.compute(9'000, out);  // clockwise: to the right, which is -y
  EXPECT_NEAR(out.x_m[0], 0.0, 1e-5);
  EXPECT_NEAR(out.y_m[0], -20.0, 1e-5);
  EXPECT_NEAR(out.z_m[0], 2.0, 1e-6);
  EXPECT_NEAR(out.ground_range_m[0], 20.0, 1e-5);
}

}  // namespace
}  // namespace terracut::hdl64e
