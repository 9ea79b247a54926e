// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::mount {

RigidTransform T_vehicle_lidar(const Mount& mount) noexcept {
  const double cp = std::cos(mount.pitch_rad), sp = std::sin(mount.pitch_rad);
  const double cr = std::cos(mount.roll_rad), sr = std::sin(mount.roll_rad);
  // rotate_y(pitch) * rotate_x(roll)
  return {cp,  sp * sr, sp * cr, 0.0,  //
          0.0, cr,      -sr,     0.0,  //
          -sp, cp * sr, cp * cr, mount.height_m};
}

Mount on_top_of(const Mount& turn, const Mount& seen) noexcept {
  const RigidTransform T = T_vehicle_lidar(turn), T_seen = T_vehicle_lidar(seen);
  std::array<double, 3> up{};  // the ground's normal in the sensor frame
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) up[axis] += T_seen[8 + i] * T[4 * i + axis];
  }
  return {seen.height_m, nearest_turn(std::atan2(up[1], up[2]), turn.roll_rad),
          std::asin(std::clamp(-up[0], -1.0, 1.0))};
}

}  // namespace terracut::mount
