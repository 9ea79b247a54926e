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
  Mount deviation;  ///< Standard deviations of the mount, which depend on how much ground is seen.
  /// The bend of the ground along the strip: at x the ground lies bend * x^2 above its tangent.
  double bend_per_m = 0;
};

/// Returns the mount that makes the ground below the sensor level and at height zero. `points` come
/// from one frame, in the sensor frame (calib/mount/mount.hpp), and only from the strip that the
/// vehicle stands on, because beside it roads fall away and pavements rise. Uses only finite points
/// 3 to 15 m from the sensor and needs at least 150. Finds heights of 0.2 to 6 m and tilts up to 15
/// degrees. Deterministic. Start-up only: allocates, takes milliseconds.
///
/// The ground may bend along the strip, as where a slope begins; the mount is measured from the
/// ground's tangent below the sensor. Ground counts by area, however densely it is seen. Fails with
/// kMalformed if there are too few points or no plane holds a fifth of them; the message says what
/// was found.
[[nodiscard]] Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points);

}  // namespace terracut::mount
