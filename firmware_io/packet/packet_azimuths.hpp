// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

#include "calib/beams/angle.hpp"
#include "firmware_io/packet/rotor_sector.hpp"

namespace terracut::packet {

/// The unit of head and beam azimuths in all decoders, 1e-5 degrees (0.02 mm at 120 m): a
/// thousandth of the hundredth of a degree in which sensors send azimuths. Whole numbers make every
/// program agree on azimuths.
inline constexpr std::int32_t kTicksPerCdeg = 1000;
inline constexpr std::int32_t kRevolution_ticks = beams::kRevolution_cdeg * kTicksPerCdeg;
inline constexpr double kRadPerTick = beams::deg_to_rad(1e-5);

/// A measured period may differ from the model's by one part in this number, though the clocks that
/// time firings are good to parts in a million.
inline constexpr std::int32_t kPeriodTolerance = 8;

/// Returns the time from one stamp to another of a device clock that counts [0, wrap_us). Of the
/// possible steps the shortest is returned, in [-wrap_us / 2, wrap_us / 2).
[[nodiscard]] constexpr std::int64_t clock_step_us(std::int64_t from_us, std::int64_t to_us,
                                                   std::int64_t wrap_us) noexcept {
  const std::int64_t step_us = (to_us - from_us) % wrap_us;
  if (step_us >= wrap_us / 2) return step_us - wrap_us;
  return step_us < -(wrap_us / 2) ? step_us + wrap_us : step_us;
}

/// The head's azimuths and times in one data packet of a spinning sensor: all that is needed to
/// order packets and to separate frames. The sensor's trait fills this in and guarantees that
/// azimuths are in range and advance.
struct PacketAzimuths {
  static constexpr int kMaxColumns = 32;  ///< An Ouster's 16 in dual return.

  /// Device stamp, [0, Sensor::kClockWrap_us), taken at the same place of every packet, so that it
  /// advances evenly.
  std::int64_t device_stamp_us = 0;
  bool clock_restarts = false;  ///< True if earlier stamps cannot be compared with this packet's.
  /// Device time from packet to packet in the packet's return mode: the model's nominal value, and
  /// the range of real units. All > 0.
  std::int32_t nominal_period_ns = 0, shortest_period_ns = 0, longest_period_ns = 0;
  std::array<std::int32_t, kMaxColumns> azimuth_cdeg{};  ///< Azimuth of each column, [0, 36000).
  int columns = 0;
  /// Index of the first column fired after the blind sector, if the head passed the sector in the
  /// middle of the packet; 0 if it did not.
  int behind_sector = 0;
  std::int32_t step_ticks = 0;  ///< Rotation from firing to firing, > 0.
  /// Rotation from this packet's first firing to the next packet's, > 0, including a blind sector
  /// in between. A firing whose second return is in the next packet belongs to that packet.
  std::int32_t sweep_ticks = 0;
  std::int32_t pace_ticks = 0;    ///< Rotation in a nominal period, > 0.
  std::int32_t widest_ticks = 0;  ///< The largest sweep of a packet in this return mode, > 0.
  bool dual_return = false;       ///< Columns come in pairs: two returns of one firing.

  [[nodiscard]] std::int32_t first_cdeg() const noexcept { return azimuth_cdeg[0]; }
  [[nodiscard]] std::int32_t last_cdeg() const noexcept {
    return azimuth_cdeg[static_cast<std::size_t>(columns - 1)];
  }
  /// Returns the angle from the first column to `column`, hundredths of a degree; jitter may make
  /// it negative.
  [[nodiscard]] std::int32_t advance_cdeg(int column) const noexcept {
    const std::int32_t cdeg =
        beams::step_cdeg(azimuth_cdeg[0], azimuth_cdeg[static_cast<std::size_t>(column)]);
    const bool is_behind = behind_sector > 0 && column >= behind_sector;
    return is_behind && cdeg < 0 ? cdeg + beams::kRevolution_cdeg : cdeg;
  }
  /// Returns the azimuths inside the packet at which the head fired nothing. `first_ticks` is its
  /// azimuth at the first column; needs behind_sector > 0.
  [[nodiscard]] RotorInterval sector_inside(std::int64_t first_ticks) const noexcept {
    return {
        first_ticks + std::int64_t{advance_cdeg(behind_sector - 1)} * kTicksPerCdeg + step_ticks,
        first_ticks + std::int64_t{advance_cdeg(behind_sector)} * kTicksPerCdeg};
  }
  /// Returns about how long the head took to pass the blind sector inside the packet; 0 if there is
  /// none.
  [[nodiscard]] std::int64_t sector_ns() const noexcept {
    return behind_sector > 0 ? sector_inside(0).ticks() * nominal_period_ns / pace_ticks : 0;
  }
};

}  // namespace terracut::packet
