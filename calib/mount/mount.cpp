// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount.hpp"

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

}  // namespace terracut::mount
