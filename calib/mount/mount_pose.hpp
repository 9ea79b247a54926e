// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cmath>

#include "calib/mount/mount.hpp"

namespace terracut::mount {

/// A frame's place in another, as trees of transforms have it.
struct Pose {
  std::array<double, 3> translation_m{};
  std::array<double, 4> rotation_xyzw{0, 0, 0, 1};  ///< A unit quaternion.
};

/// The vehicle frame as it lies in the sensor frame.
[[nodiscard]] inline Pose vehicle_in_lidar(const Mount& mount) noexcept {
  const RigidTransform T = T_vehicle_lidar(mount);
  const double cp = std::cos(mount.pitch_rad / 2), sp = std::sin(mount.pitch_rad / 2);
  const double cr = std::cos(mount.roll_rad / 2), sr = std::sin(mount.roll_rad / 2);
  // The inverse of a rotation is its transpose; of its quaternion, the conjugate.
  return {{-mount.height_m * T[8], -mount.height_m * T[9], -mount.height_m * T[10]},
          {-cp * sr, -sp * cr, sp * sr, cp * cr}};
}

}  // namespace terracut::mount
