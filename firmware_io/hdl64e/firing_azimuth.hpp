// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "firmware_io/hdl64e/firing_times.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"

/// Computes the azimuth of each laser's beam when it fires, in whole numbers, so that the decoder,
/// the encoder and the truth beside a capture agree bit for bit on the frame and order of every
/// return.
///
/// A column of a packet carries one azimuth for 64 lasers: the head's at the column's first firing.
/// While the lasers fire one group after another the head rotates on by almost a column:
///
///   head at the firing of laser i = azimuth of its column + advance(i)
///   beam of laser i               = head at its firing    - rotational correction(i)
///
/// both clockwise from straight ahead. `offset` below is beam minus column azimuth. The step from
/// column to column is taken from the packet's own first and last azimuth, so nothing depends on a
/// nominal spin rate. Angles are in ticks (packet_azimuths.hpp). Everything here is allocation-free
/// and noexcept; any thread.
namespace terracut::hdl64e {

/// Returns how far the head rotates from one column to the next, in ticks, from the packet's first
/// and last azimuth as sent, [0, 36000). Exact: both divisors divide kTicksPerCdeg.
[[nodiscard]] constexpr std::int32_t column_step_ticks(int first_cdeg, int last_cdeg,
                                                       bool dual_return = false) noexcept {
  const int columns = dual_return ? kColumnsPerPacketDual : kColumnsPerPacketSingle;
  return beams::step_cdeg(first_cdeg, last_cdeg) * (packet::kTicksPerCdeg / (columns - 1));
}

/// A firing share is the part of the column period after which laser 0..31 of a block fires, in
/// units of 1 / 2^20.
inline constexpr int kFiringShareBits = 20;
[[nodiscard]] constexpr std::array<std::int64_t, kLasersPerBlock> firing_shares(
    const FiringTimes& times) noexcept {
  std::array<std::int64_t, kLasersPerBlock> shares{};
  for (int j = 0; j < kLasersPerBlock; ++j) {
    shares[static_cast<std::size_t>(j)] =
        (std::int64_t{times.laser_ns(j)} << kFiringShareBits) / times.column_ns;
  }
  return shares;
}
/// The shares for single return are those of the 48 us cycle for all units. The cycle of a unit
/// shows only after some packets, but its first packet already needs shares; those of the 57.6 us
/// cycle differ by at most 0.013 of a step (0.002 degrees at 10 Hz).
inline constexpr auto kFiringSharesSingle = firing_shares(kFiringTimesSingle48);
inline constexpr auto kFiringSharesDual = firing_shares(kFiringTimesDual);

/// Returns how far the head has rotated, in ticks, from its column's azimuth when `laser` (0..63)
/// fires. `step_ticks` comes from column_step_ticks() and is >= 0.
[[nodiscard]] constexpr std::int32_t firing_advance_ticks(std::int32_t step_ticks, int laser,
                                                          bool dual_return = false) noexcept {
  const auto& shares = dual_return ? kFiringSharesDual : kFiringSharesSingle;
  const std::int64_t share = shares[static_cast<std::size_t>(laser % kLasersPerBlock)];
  return static_cast<std::int32_t>((step_ticks * share) >> kFiringShareBits);
}

/// Returns a laser's rotational correction rounded to ticks, as all azimuths in whole numbers use
/// it.
[[nodiscard]] inline std::int32_t rot_correction_ticks(const Hdl64eLaser& laser) noexcept {
  return static_cast<std::int32_t>(std::lround(laser.rot_correction_rad / packet::kRadPerTick));
}

/// The azimuth offsets of all 64 beams of one unit from their column.
class BeamOffsets {
 public:
  explicit BeamOffsets(const Hdl64eCalibration& calibration) noexcept {
    for (std::size_t i = 0; i < rot_ticks_.size(); ++i) {
      rot_ticks_[i] = rot_correction_ticks(calibration.lasers[i]);
    }
    const auto [least, most] = std::minmax_element(rot_ticks_.begin(), rot_ticks_.end());
    least_rot_ticks_ = *least;
    most_rot_ticks_ = *most;
  }

  [[nodiscard]] std::int32_t offset_ticks(std::int32_t step_ticks, int laser,
                                          bool dual_return = false) const noexcept {
    return firing_advance_ticks(step_ticks, laser, dual_return) -
           rot_ticks_[static_cast<std::size_t>(laser)];
  }
  /// hindmost_ticks() and foremost_ticks() return the least and the greatest offset of all beams.
  [[nodiscard]] std::int32_t hindmost_ticks() const noexcept { return -most_rot_ticks_; }
  [[nodiscard]] std::int32_t foremost_ticks(std::int32_t step_ticks) const noexcept {
    return step_ticks - least_rot_ticks_;
  }

 private:
  std::array<std::int32_t, kHdl64eLasers> rot_ticks_{};
  std::int32_t least_rot_ticks_ = 0, most_rot_ticks_ = 0;
};

}  // namespace terracut::hdl64e
