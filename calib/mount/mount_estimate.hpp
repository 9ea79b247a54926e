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
  Mount deviation;  ///< Standard deviations of its figures, by how much of the ground is seen.
  /// How the ground bends along the strip: x ahead or behind it is bend * x^2 above its tangent.
  double bend_per_m = 0;
};

/// The mount that makes the ground below the sensor level and at height zero. `points` are of the
/// sensor frame (calib/mount/mount.hpp), of one frame, and of the strip that the vehicle stands on:
/// beside it roads fall away and pavements rise. Looked at are those 3 to 15 m from the sensor,
/// which have to be 150; points that are not finite are left out. Heights of 0.2 to 6 m are found,
/// and tilts up to 15 degrees. Deterministic: the same points give the same mount. Start-up only:
/// allocates, takes milliseconds.
///
/// Along the strip the ground may bend, as it does where a slope begins; the mount is that over
/// its tangent below the sensor. All of the ground counts alike, however densely it is seen.
/// kMalformed when there are too few points or no plane holds a fifth of them; the message says
/// which and what was found.
[[nodiscard]] Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points);

}  // namespace terracut::mount
