// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <span>

#include "calib/mount/mount.hpp"
#include "rt/error.hpp"

namespace terracut::mount {

struct MountEstimate {
  Mount mount;
  Mount deviation;  ///< Standard deviations, by how much ground is seen.
  /// The ground's bend along the strip: at x it lies bend * x^2 above its tangent.
  double bend_per_m = 0;
};

/// Returns the mount that makes the ground below the sensor level and at height zero. `points`: one
/// frame, sensor frame (calib/mount/mount.hpp), of the strip that the vehicle stands on, because
/// beside it roads fall away and pavements rise. Only finite points 3 to 15 m from the sensor are
/// used; at least 150 are needed. Finds heights of 0.2 to 6 m and tilts up to 15 degrees.
/// Deterministic. Start-up only: allocates, takes milliseconds.
///
/// The ground may bend along the strip, as it does where a slope begins; the mount is measured from
/// its tangent below the sensor. Ground counts by area, however densely it is seen. kMalformed when
/// there are too few points or no plane holds a fifth of them; the message says what was found.
[[nodiscard]] Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points);

}  // namespace terracut::mount
