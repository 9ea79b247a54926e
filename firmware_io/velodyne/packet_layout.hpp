// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"

/// The data packet of Velodyne's models after the HDL-64E: the same twelve blocks, the stamp of the
/// first firing, then return mode and product number instead of a status stream
/// (docs/reference/sensors.md).
namespace terracut::velodyne {

inline constexpr std::size_t kPacketBytes = hdl64e::kHdl64ePacketBytes;
inline constexpr int kBlocks = hdl64e::kBlocksPerPacket;
inline constexpr int kBlockReturns = hdl64e::kLasersPerBlock;
inline constexpr std::int64_t kClockWrap_us = hdl64e::kDeviceHour_us;

/// Values of the return mode, the byte after the stamp.
inline constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;

/// What differs between the models' packets. A column has one head azimuth: it is one block, or all
/// blocks that one firing fills.
struct PacketLayout {
  sensor::SensorModel model{};
  std::array<std::uint16_t, 4> block_ids{};  ///< Ids of a column's blocks, as many as it has.
  int blocks_per_column = 1;
  int columns_dual = kBlocks;  ///< In dual return, counting both returns of a pair.
  std::int32_t column_ns = 0;  ///< Time from one column's first firing to the next column's.
  std::int32_t firing_ns = 0;  ///< Time from one firing of all lasers to the next.

  [[nodiscard]] constexpr int columns(bool dual_return) const noexcept {
    return dual_return ? columns_dual : kBlocks / blocks_per_column;
  }
  [[nodiscard]] constexpr int firings(bool dual_return) const noexcept {
    return dual_return ? columns_dual / 2 : columns(false);
  }
  /// Returns the block of a column that holds its part number `part`. In dual return the two
  /// returns of a part are in adjacent blocks.
  [[nodiscard]] constexpr std::size_t block(int column, int part, bool dual_return) const noexcept {
    const int pairs_before = column / 2 * blocks_per_column + part;
    return static_cast<std::size_t>(dual_return ? 2 * pairs_before + column % 2
                                                : column * blocks_per_column + part);
  }
  /// Returns the most that the head may rotate in a column: its rotation at 30 Hz, while the
  /// sensors spin at 5 to 20.
  [[nodiscard]] constexpr int most_step_cdeg() const noexcept {
    return static_cast<int>(std::int64_t{36'000} * 30 * column_ns / 1'000'000'000) + 1;
  }
};

/// Returns how far the head rotates from firing to firing, ticks, from its advance between a
/// packet's first and last firing, of `firings` > 1.
[[nodiscard]] constexpr std::int32_t mean_step_ticks(std::int32_t advance_cdeg,
                                                     int firings) noexcept {
  return advance_cdeg * packet::kTicksPerCdeg / (firings - 1);
}
/// Returns the step at 10 Hz, used for packets of one firing until the rate is known.
[[nodiscard]] constexpr std::int32_t assumed_step_ticks(const PacketLayout& layout) noexcept {
  return static_cast<std::int32_t>(std::int64_t{packet::kRevolution_ticks} * 10 * layout.column_ns /
                                   1'000'000'000);
}

/// Returns how far the head has rotated from its column's azimuth when a group of channels fires,
/// ticks.
template <class Model>
[[nodiscard]] constexpr std::int32_t advance_ticks(std::int32_t step_ticks,
                                                   std::size_t group) noexcept {
  return static_cast<std::int32_t>(std::int64_t{step_ticks} * Model::group_ns(group) /
                                   Model::kLayout.column_ns);
}

/// Largest accepted backwards step from column to column.
inline constexpr int kMaxJitter_cdeg = 5;
/// Smallest mean step from column to column; a head that advances less counts as standing still.
inline constexpr int kMinStep_cdeg = 2;

}  // namespace terracut::velodyne
