// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "calib/beams/beam_table.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/table/column_pace.hpp"

namespace terracut::table {

/// The azimuth offsets of a model's beams from their column, by channel, in whole numbers
/// (firmware_io/packet/beam_azimuth.hpp), for decoder and encoder. Allocation-free.
template <class Model>
class BeamOffsets {
 public:
  explicit BeamOffsets(const beams::BeamTable& calibration) noexcept {
    for (std::size_t channel = 0; channel < ticks_.size(); ++channel) {
      const double offset_rad = calibration.lasers[channel % Model::kLasers].azimuth_offset_rad;
      ticks_[channel] = static_cast<std::int32_t>(std::lround(offset_rad / packet::kRadPerTick));
    }
    const auto [least, most] = std::ranges::minmax(ticks_);
    least_ticks_ = least;
    most_ticks_ = most;
  }

  /// Returns the beam's offset from the head when its channel fires.
  [[nodiscard]] std::int32_t beam_ticks(int channel) const noexcept {
    return ticks_[static_cast<std::size_t>(channel)];
  }
  /// Returns the beam's offset from its column's azimuth.
  [[nodiscard]] std::int32_t offset_ticks(std::int32_t step_ticks, int channel) const noexcept {
    const std::size_t group = Model::group(static_cast<std::size_t>(channel));
    return advance_ticks<Model>(step_ticks, group) + beam_ticks(channel);
  }
  /// hindmost_ticks() and foremost_ticks() return the least and the greatest offset of all beams
  /// for a step.
  [[nodiscard]] std::int32_t hindmost_ticks() const noexcept { return least_ticks_; }
  [[nodiscard]] std::int32_t foremost_ticks(std::int32_t step_ticks) const noexcept {
    return step_ticks + most_ticks_;
  }

 private:
  std::array<std::int32_t, Model::kChannels> ticks_{};
  std::int32_t least_ticks_ = 0, most_ticks_ = 0;
};

}  // namespace terracut::table
