// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "firmware_io/frame/frame_info.hpp"

namespace terracut::points {

/// From this the times of a frame's returns are computed, assuming that the head rotated evenly
/// from the first packet to the last. The default gives 0 for all returns; it is for clouds without
/// times.
struct FrameTiming {
  frame::HeadSweep head;
  double duration_s = 0;              ///< Time from the first packet to the last.
  std::span<const float> beam_turns;  ///< decode::Decoder::beam_turns(), one per row, or empty.

  /// Returns the timing of a frame. `beam_turns` is that of the decoder that made the frame.
  [[nodiscard]] static FrameTiming of(const frame::FrameInfo& info,
                                      std::span<const float> beam_turns) noexcept {
    constexpr double kSecond_ns = 1e9;
    return {info.head, static_cast<double>(info.last_packet_ns - info.first_packet_ns) / kSecond_ns,
            beam_turns};
  }
};

/// The times of measurement in a row: its beam measures column 0 at `first_s` and each further
/// column `step_s` later.
struct RowTimes {
  float first_s = 0, step_s = 0;  ///< Both 0: not known.

  /// Returns the times of a row of an image with that many columns.
  [[nodiscard]] static RowTimes of(int row, int columns, const FrameTiming& timing) noexcept {
    const float swept_turns = timing.head.last_turns - timing.head.first_turns;
    const auto n = static_cast<std::size_t>(row);
    if (n >= timing.beam_turns.size() || swept_turns <= 0) return {};
    const float turn_s = static_cast<float>(timing.duration_s) / swept_turns;
    const float column_turns = 1.0F / static_cast<float>(columns);
    const float head_turns = column_turns / 2 - timing.beam_turns[n];
    return {(head_turns - timing.head.first_turns) * turn_s, column_turns * turn_s};
  }

  [[nodiscard]] float at(int column) const noexcept {
    return std::max(first_s + static_cast<float>(column) * step_s, 0.0F);
  }
  /// Returns the column that was measured at a time above 0. The times must be known.
  [[nodiscard]] int column_at(float time_s) const noexcept {
    return static_cast<int>(std::floor((time_s - first_s) / step_s + 0.5F));
  }
};

}  // namespace terracut::points
