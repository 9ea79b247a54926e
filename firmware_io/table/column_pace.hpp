// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/packet/packet_azimuths.hpp"

namespace terracut::table {

/// The columns of a sensor's packets in time. A column has one head azimuth.
struct ColumnPace {
  std::int32_t column_ns = 0;  ///< Time from one column's first firing to the next column's.
  int firings_single = 1;      ///< Columns of a packet that differ in time: in single return ...
  int firings_dual = 1;        ///< ... and in dual return, where they come in pairs.

  [[nodiscard]] constexpr int firings(bool dual_return) const noexcept {
    return dual_return ? firings_dual : firings_single;
  }
  /// Returns the most that the head may rotate in a column: its rotation at 30 Hz, while the
  /// sensors spin at 5 to 20.
  [[nodiscard]] constexpr int most_step_cdeg() const noexcept {
    return static_cast<int>(std::int64_t{beams::kRevolution_cdeg} * 30 * column_ns /
                            1'000'000'000) +
           1;
  }
  /// Returns the step at 10 Hz, used for packets of one firing until the rate is known.
  [[nodiscard]] constexpr std::int32_t assumed_step_ticks() const noexcept {
    return static_cast<std::int32_t>(std::int64_t{packet::kRevolution_ticks} * 10 * column_ns /
                                     1'000'000'000);
  }
};

/// Returns how far the head rotates from firing to firing, ticks, from its advance between a
/// packet's first and last firing, of `firings` > 1.
[[nodiscard]] constexpr std::int32_t mean_step_ticks(std::int32_t advance_cdeg,
                                                     int firings) noexcept {
  return advance_cdeg * packet::kTicksPerCdeg / (firings - 1);
}

/// Returns how far the head has rotated from its column's azimuth when a group of channels of
/// `Model` fires, ticks.
template <class Model>
[[nodiscard]] constexpr std::int32_t advance_ticks(std::int32_t step_ticks,
                                                   std::size_t group) noexcept {
  return static_cast<std::int32_t>(std::int64_t{step_ticks} * Model::group_ns(group) /
                                   Model::kPace.column_ns);
}

/// Returns how far the lens of `Model` is ahead of the axis of rotation.
template <class Model>
[[nodiscard]] constexpr double lens_ahead_m() noexcept {
  if constexpr (requires { Model::kLensAhead_m; }) return Model::kLensAhead_m;
  return 0;
}

/// Largest accepted backwards step from column to column.
inline constexpr int kMaxJitter_cdeg = 5;
/// Smallest mean step from column to column; a head that advances less counts as standing still.
inline constexpr int kMinStep_cdeg = 2;

}  // namespace terracut::table
