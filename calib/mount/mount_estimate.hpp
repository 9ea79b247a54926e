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

/// The part of the ground before and behind the vehicle from which a mount is estimated.
struct Strip {
  double farthest_m;  ///< Points farther from the sensor are not used.
  /// The expected size of the ground's bend, in z = bend x^2, before anything of it is seen.
  double usual_bend_per_m;
};
/// The strip for sensors that see the ground near them: it may bend as where a slope begins, with a
/// radius of 170 m.
inline constexpr Strip kNearStrip{.farthest_m = 15.0, .usual_bend_per_m = 0.003};
/// The strip for sensors that see too few points of kNearStrip. Height and pitch are extrapolated
/// from far ground, so only a small bend is expected: a free one would leave both unknown.
inline constexpr Strip kFarStrip{.farthest_m = 30.0, .usual_bend_per_m = 0.0003};

/// Returns the mount that makes the ground below the sensor level and at height zero. `points` come
/// from one frame, in the sensor frame (calib/mount/mount.hpp), and only from the strip that the
/// vehicle stands on, because beside it roads fall away and pavements rise. Uses only finite points
/// of `strip` (at most kFarStrip) at least 3 m from the sensor, and needs at least 150. Finds
/// heights of 0.2 to 6 m and tilts up to 15 degrees. Deterministic. Start-up only: allocates, takes
/// milliseconds.
///
/// The ground may bend along the strip, as where a slope begins; the mount is measured from the
/// ground's tangent below the sensor. Ground counts by area, however densely it is seen. Fails with
/// kMalformed if there are too few points or no plane holds a fifth of them; the message says what
/// was found.
[[nodiscard]] Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points,
                                                     const Strip& strip = kNearStrip);

}  // namespace terracut::mount
