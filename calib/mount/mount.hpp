// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace terracut::mount {

/// The sensor's pose on the vehicle.
///
/// Vehicle frame (REP-103): x forward, y left, z up, metres; its origin lies on the ground plane
/// straight below the sensor, so z is the height above that plane. Sensor frame: x forward, y left,
/// z up of the sensor itself, origin at the sensor. T_vehicle_lidar = translate(0, 0, height) *
/// rotate_y(pitch) * rotate_x(roll): positive pitch looks down in front, positive roll lifts the
/// left side.
struct Mount {
  double height_m = 1.73;  ///< Sensor origin above the ground plane; (0.2, 6).
  double roll_rad = 0;     ///< Roll in [-pi, pi]; at either end the sensor is upside down.
  double pitch_rad = 0;    ///< [-pi/2, pi/2]
};

/// True if the mount's angles are in the ranges above, with room for pi rounded to float.
[[nodiscard]] inline bool has_possible_angles(const Mount& mount) noexcept {
  constexpr double kRounding_rad = 1e-6;
  return std::abs(mount.roll_rad) <= std::numbers::pi + kRounding_rad &&
         std::abs(mount.pitch_rad) <= std::numbers::pi / 2 + kRounding_rad;
}

/// True if the sensor's z axis points down: its highest beams then point lowest in the vehicle
/// frame.
[[nodiscard]] inline bool is_upside_down(const Mount& mount) noexcept {
  return std::cos(mount.roll_rad) * std::cos(mount.pitch_rad) < 0;
}

/// Renumbers rows of the range image, counted from the lowest in the sensor frame, so that 0 is the
/// lowest in the vehicle frame.
template <class Rows>
[[nodiscard]] Rows rows_upward(Rows rows, const Mount& mount) noexcept {
  if (is_upside_down(mount)) {
    for (auto& row : rows) row = static_cast<int>(rows.size()) - 1 - row;
  }
  return rows;
}

/// Row-major 3x4 [R
/// t] that takes a point from the sensor to the vehicle frame.
using RigidTransform = std::array<double, 12>;

[[nodiscard]] RigidTransform T_vehicle_lidar(const Mount& mount) noexcept;

/// Returns `angle_rad`, or that angle plus or minus one revolution, whichever is nearest to
/// `to_rad`.
[[nodiscard]] constexpr double nearest_turn(double angle_rad, double to_rad) noexcept {
  const double by_rad = angle_rad - to_rad;
  if (by_rad > std::numbers::pi) return angle_rad - 2 * std::numbers::pi;
  return by_rad < -std::numbers::pi ? angle_rad + 2 * std::numbers::pi : angle_rad;
}

/// Combines two mounts: `turn` rotates the sensor frame to another frame, in which the mount `seen`
/// was estimated. The height of `turn` is ignored. Of equivalent rolls the one nearest to that of
/// `turn` is returned.
[[nodiscard]] Mount on_top_of(const Mount& turn, const Mount& seen) noexcept;

[[nodiscard]] constexpr std::array<double, 3> apply(const RigidTransform& T, double x, double y,
                                                    double z) noexcept {
  return {T[0] * x + T[1] * y + T[2] * z + T[3], T[4] * x + T[5] * y + T[6] * z + T[7],
          T[8] * x + T[9] * y + T[10] * z + T[11]};
}

}  // namespace terracut::mount
