// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>

namespace terracut::mount {

/// How the sensor stands on the vehicle.
///
/// Vehicle frame (REP-103): x forward, y left, z up, metres; its origin lies on the ground plane
/// straight below the sensor, so z is the height above that plane. Sensor frame: x forward, y left,
/// z up of the sensor itself, origin at the sensor. T_vehicle_lidar = translate(0, 0, height) *
/// rotate_y(pitch) * rotate_x(roll): positive pitch looks down in front, positive roll lifts the
/// left side.
struct Mount {
  double height_m = 1.73;  ///< Sensor origin above the ground plane; (0.2, 6).
  double roll_rad = 0;     ///< (-0.5, 0.5)
  double pitch_rad = 0;    ///< (-0.5, 0.5)
};

/// Row-major 3x4 [R | t] that takes a point of the sensor frame to the vehicle frame.
using RigidTransform = std::array<double, 12>;

[[nodiscard]] RigidTransform T_vehicle_lidar(const Mount& mount) noexcept;

[[nodiscard]] constexpr std::array<double, 3> apply(const RigidTransform& T, double x, double y,
                                                    double z) noexcept {
  return {T[0] * x + T[1] * y + T[2] * z + T[3], T[4] * x + T[5] * y + T[6] * z + T[7],
          T[8] * x + T[9] * y + T[10] * z + T[11]};
}

}  // namespace terracut::mount
