// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <numbers>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/point_distance.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/run.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::objects {

/// How far apart returns may be that are seen so many radians apart: `gap_m`, or more, up to twice
/// that.
struct RowReach {
  float gap_m, steps_rad;

  /// Returns the square of the reach for returns of that horizontal range, or of four such ranges.
  template <class Numbers>
  [[nodiscard]] Numbers squared_m2(Numbers range_m) const noexcept {
    const Numbers least_m = Numbers{} + gap_m;
    const Numbers reach_m = lesser(greater(steps_rad * range_m, least_m), 2 * least_m);
    return reach_m * reach_m;
  }
};

/// Tells how far apart returns of neighbouring cells may be and still belong together: `gap_m`, or
/// more, up to twice that, where beams lie far apart: two steps between rows, or eight between
/// columns, because a car's side may be seen at a grazing angle (7 degrees).
class Reach {
 public:
  /// `profile` must have shape.rows rings.
  Reach(float gap_m, const mount::RingProfile& profile, frame::ImageShape shape,
        memory::FixedMemory& memory)
      : gap_m_(gap_m),
        column_step_rad_(2 * std::numbers::pi_v<float> / static_cast<float>(shape.columns)),
        row_steps_rad_(memory.take<float>("objects", profile.rings.size())) {
    for (std::size_t row = 0; row + 1 < row_steps_rad_.size(); ++row) {
      row_steps_rad_[row] = static_cast<float>(profile.rings[row + 1].elevation_rad -
                                               profile.rings[row].elevation_rad);
    }
  }

  /// Returns the square of the reach along a row for returns of that horizontal range, or of four
  /// such ranges.
  template <class Numbers>
  [[nodiscard]] Numbers along_row_squared_m2(Numbers range_m) const noexcept {
    return RowReach{gap_m_, 8 * column_step_rad_}.squared_m2(range_m);
  }
  /// Returns the reach from a row to the next higher one.
  [[nodiscard]] RowReach to_next_row(int row) const noexcept {
    return {gap_m_, 2 * row_steps_rad_[static_cast<std::size_t>(row)]};
  }

 private:
  float gap_m_, column_step_rad_;
  std::span<float> row_steps_rad_;  // by the lower row
};

}  // namespace terracut::objects
