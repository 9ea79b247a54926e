// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "calib/mount/mount.hpp"

namespace terracut::mount {

/// The pose of one frame in another, in the form that transform trees (ROS tf) store.
struct Pose {
  std::array<double, 3> translation_m{};
  std::array<double, 4> rotation_xyzw{0, 0, 0, 1};  ///< A unit quaternion.
};

/// Returns the pose of the vehicle frame in the sensor frame.
[[nodiscard]] inline Pose vehicle_in_lidar(const Mount& mount) noexcept {
  const RigidTransform T = T_vehicle_lidar(mount);
  const double cp = std::cos(mount.pitch_rad / 2), sp = std::sin(mount.pitch_rad / 2);
  const double cr = std::cos(mount.roll_rad / 2), sr = std::sin(mount.roll_rad / 2);
  // The inverse of a rotation is its transpose, that of a unit quaternion its conjugate.
  return {{-mount.height_m * T[8], -mount.height_m * T[9], -mount.height_m * T[10]},
          {-cp * sr, -sp * cr, sp * sr, cp * cr}};
}

/// Returns the pose that the transform gives its frame; of its two quaternions the one with w >= 0.
[[nodiscard]] Pose pose_of(const RigidTransform& T) noexcept;

/// Returns the inverse transform.
[[nodiscard]] constexpr RigidTransform inverse(const RigidTransform& T) noexcept {
  const auto turned_back = [&](std::size_t axis) {
    return -(T[axis] * T[3] + T[4 + axis] * T[7] + T[8 + axis] * T[11]);
  };
  return {T[0], T[4], T[8],  turned_back(0),  //
          T[1], T[5], T[9],  turned_back(1),  //
          T[2], T[6], T[10], turned_back(2)};
}

/// Returns the transform that does `second` after `first`.
[[nodiscard]] constexpr RigidTransform chained(const RigidTransform& second,
                                               const RigidTransform& first) noexcept {
  RigidTransform T{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? second[4 * row + 3] : 0;
      for (std::size_t i = 0; i < 3; ++i) sum += second[4 * row + i] * first[4 * i + column];
      T[4 * row + column] = sum;
    }
  }
  return T;
}

}  // namespace terracut::mount
