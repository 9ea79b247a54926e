// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>

#include "pipeline/points/labelled_points.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::points {

/// The times of measurement in a row: its beam measures column 0 at `first_s` and each further
/// column `step_s` later. Both are 0 where times are not known.
struct RowTimes {
  float first_s = 0, step_s = 0;

  /// Returns the times of a row of an image with `columns` columns.
  [[nodiscard]] static RowTimes of(int row, int columns,
                                   const FrameTiming& timing) noexcept TERRACUT_NONBLOCKING {
    const float swept_turns = timing.head.last_turns - timing.head.first_turns;
    const auto n = static_cast<std::size_t>(row);
    if (n >= timing.beam_turns.size() || swept_turns <= 0) return {};
    const float turn_s = static_cast<float>(timing.duration_s) / swept_turns;
    const float column_turns = 1.0F / static_cast<float>(columns);
    const float head_turns = column_turns / 2 - timing.beam_turns[n];
    return {(head_turns - timing.head.first_turns) * turn_s, column_turns * turn_s};
  }

  /// Returns when a column is measured, after the frame's beginning.
  [[nodiscard]] float at(int column) const noexcept {
    return std::max(first_s + static_cast<float>(column) * step_s, 0.0F);
  }
  /// True if column_at() is known.
  [[nodiscard]] bool tells_columns() const noexcept { return step_s > 0; }
  /// Returns the column, perhaps outside of the image, that is measured at this time.
  [[nodiscard]] int column_at(float time_s) const noexcept {
    constexpr float kFarthest = 1e6F;  // no image is as wide
    const float column = (time_s - first_s) / step_s + 0.5F;
    return static_cast<int>(std::clamp(column, -1.0F, kFarthest));
  }
};

}  // namespace terracut::points
