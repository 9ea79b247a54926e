// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/mount_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "calib/beams/angle.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::ground {
namespace {

using beams::deg_to_rad;
using beams::rad_to_deg;
using mount::Mount;

/// A sensor of 32 rows in the middle of a square, between houses of different heights 40 m away.
struct Sensor {
  Mount mount;
  double lowest_deg, highest_deg;
  double sector_deg = 360;  ///< The sector that it sees, in the middle of which is straight ahead.
  /// The height of the ground at a place ahead, in the vehicle frame.
  std::function<double(double x_m)> ground_m = [](double) { return 0.0; };
};

/// Follows a beam and returns its length where it meets the ground or the wall; 0 where neither.
double length_m(const Sensor& sensor, const mount::RigidTransform& T,
                const std::array<double, 3>& beam) {
  constexpr double kStep_m = 0.2, kFarthest_m = 60, kWall_m = 40;
  const auto place_at = [&](double length) {
    return mount::apply(T, length * beam[0], length * beam[1], length * beam[2]);
  };
  const auto is_stopped_at = [&](double length) {
    const auto [x, y, z] = place_at(length);
    return z <= sensor.ground_m(x) || std::max(std::abs(x), std::abs(y)) >= kWall_m;
  };
  double stopped = 1;
  while (stopped < kFarthest_m && !is_stopped_at(stopped)) stopped += kStep_m;
  double passed = stopped - kStep_m;
  for (int halved = 0; halved < 10; ++halved) {
    const double middle = (passed + stopped) / 2;
    (is_stopped_at(middle) ? stopped : passed) = middle;
  }
  const auto [x, y, z] = place_at(stopped);
  return stopped < kFarthest_m && z < 6 + 3 * std::sin(x + y) ? stopped : 0;
}

Expected<mount::FoundMount> mount_found_by(const Sensor& sensor) {
  memory::FixedMemory memory;
  const frame::ImageShape shape{32, 1800};
  frame::RangeImage image(shape, 1, memory);
  image.clear();
  const mount::RigidTransform T = T_vehicle_lidar(sensor.mount);
  for (int row = 0; row < shape.rows; ++row) {
    const double elevation_rad = deg_to_rad(
        sensor.lowest_deg + (sensor.highest_deg - sensor.lowest_deg) * row / (shape.rows - 1));
    for (int column = 0; column < shape.columns; ++column) {
      const double azimuth_rad = 2 * std::numbers::pi * (column + 0.5) / shape.columns;
      if (rad_to_deg(std::abs(mount::nearest_turn(azimuth_rad, 0))) > sensor.sector_deg / 2)
        continue;
      const std::array<double, 3> beam{std::cos(elevation_rad) * std::cos(azimuth_rad),
                                       -std::cos(elevation_rad) * std::sin(azimuth_rad),
                                       std::sin(elevation_rad)};
      const double length = length_m(sensor, T, beam);
      if (length == 0) continue;
      const auto along = [&](double share) { return static_cast<float>(length * share); };
      frame::Return point;
      point.x_m = along(beam[0]);
      point.y_m = along(beam[1]);
      point.z_m = along(beam[2]);
      point.ground_range_m = along(std::cos(elevation_rad));
      image.place(row, column, point);
    }
  }
  MountSearch search;
  for (int frame = 0; frame < 3; ++frame) search.add_frame(image);
  return search.found();
}

void expect_found(const Sensor& sensor, double height_tolerance_m, double tilt_tolerance_deg) {
  const auto found = mount_found_by(sensor);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->mount.height_m, sensor.mount.height_m, height_tolerance_m);
  EXPECT_NEAR(rad_to_deg(mount::nearest_turn(found->mount.roll_rad, sensor.mount.roll_rad)),
              rad_to_deg(sensor.mount.roll_rad), tilt_tolerance_deg);
  EXPECT_NEAR(rad_to_deg(found->mount.pitch_rad), rad_to_deg(sensor.mount.pitch_rad),
              tilt_tolerance_deg);
}

TEST(MountSearch, FindsASensorThatSeesTheGroundOfTheFrontSectorFromTenMetresOn) {
  expect_found({.mount = {1.8, deg_to_rad(-0.5), deg_to_rad(1)},
                .lowest_deg = -9,
                .highest_deg = 7,
                .sector_deg = 45},
               0.03, 0.2);
}

TEST(MountSearch, TakesTheNearGroundWhereItIsSeenThoughTheRoadRisesFartherAhead) {
  expect_found({.mount = {.height_m = 1.8},
                .lowest_deg = -25,
                .highest_deg = 15,
                .ground_m = [](double x_m) { return x_m > 15 ? 0.08 * (x_m - 15) : 0.0; }},
               0.02, 0.1);
}

TEST(MountSearch, FindsASensorUpsideDown) {
  for (const double pitch_deg : {0.0, 4.0}) {
    expect_found({.mount = {1.9, std::numbers::pi, deg_to_rad(pitch_deg)},
                  .lowest_deg = -15,
                  .highest_deg = 25},
                 0.03, 0.2);
  }
}

TEST(MountSearch, SaysWhyThereIsNoMountWhereNoGroundIsSeen) {
  const auto found = mount_found_by(
      {.mount = {.height_m = 1.8}, .lowest_deg = 1, .highest_deg = 15, .sector_deg = 45});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kMountNotFound);
}

}  // namespace
}  // namespace terracut::ground
