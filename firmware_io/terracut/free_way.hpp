// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>

namespace terracut {

/// Why ground is seen no farther without a gap.
enum class SeenEnd : std::uint8_t {
  kRows,      ///< The next row meets the ground too far behind: no beam looks between.
  kLost,      ///< Beams between returned nothing: water, black ice, a crest, an open hole.
  kObstacle,  ///< An obstacle stands there.
  kDrop,      ///< The next ground lies much lower: a hole, a step down.
  kCount,
};

/// What lies in one direction, a sector of about half a degree. Distances are horizontal, from the
/// vehicle frame's origin below the sensor, as measured: each sector from where the sensor was when
/// it looked there, also in a deskewed frame.
struct FreeWaySector {
  float azimuth_rad = 0;  ///< Of its middle, counterclockwise from straight ahead, [-pi, pi].
  /// To the nearest return that stands in the vehicle's way: an obstacle at least 0.06 m and at
  /// most 2.5 m above the ground; infinity if there is none.
  float obstacle_m = std::numeric_limits<float>::infinity();
  /// Up to here ground was seen without a gap of more than 0.9 m; 0: from the beginning not. What
  /// is nearer than the lowest laser meets the ground is never seen.
  float seen_m = 0;
  SeenEnd seen_end = SeenEnd::kRows;  ///< Why it was seen no farther.

  /// Returns up to where ground was seen and nothing stands.
  [[nodiscard]] constexpr float free_m() const noexcept {
    return obstacle_m < seen_m ? obstacle_m : seen_m;
  }
  /// Returns the distance to what a vehicle must stop for: the nearest obstacle or, before it, the
  /// edge of a drop; infinity if there is neither.
  [[nodiscard]] constexpr float stop_m() const noexcept {
    return seen_end == SeenEnd::kDrop ? free_m() : obstacle_m;
  }
};

}  // namespace terracut
