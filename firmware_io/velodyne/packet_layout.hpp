// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/sensor_model.hpp"

/// The data packet of Velodyne's models after the HDL-64E: the same twelve blocks, the stamp at the
/// first firing, and behind it the return mode and the product's number instead of a status stream
/// (docs/reference/sensors.md).
namespace terracut::velodyne {

inline constexpr std::size_t kPacketBytes = hdl64e::kHdl64ePacketBytes;
inline constexpr int kBlocks = hdl64e::kBlocksPerPacket;
inline constexpr int kBlockReturns = hdl64e::kLasersPerBlock;
inline constexpr std::int64_t kClockWrap_us = hdl64e::kDeviceHour_us;

/// The byte behind the stamp.
inline constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;

/// What a model's packets differ in. A column is what one reading of the head's azimuth is for: one
/// block or, where a firing fills more than one, all of these.
struct PacketLayout {
  sensor::SensorModel model{};
  std::array<std::uint16_t, 4> block_ids{};  ///< Of a column's blocks, so many as it has.
  int blocks_per_column = 1;
  int columns_dual = kBlocks;  ///< In dual return, where both of a pair are counted.
  std::int32_t column_ns = 0;  ///< From a column's first firing to the next column's.
  std::int32_t firing_ns = 0;  ///< From a firing of all lasers to the next.

  [[nodiscard]] constexpr int columns(bool dual_return) const noexcept {
    return dual_return ? columns_dual : kBlocks / blocks_per_column;
  }
  [[nodiscard]] constexpr int firings(bool dual_return) const noexcept {
    return dual_return ? columns_dual / 2 : columns(false);
  }
  /// The block of a column that holds its part number `part`. In dual return the two returns of a
  /// part are side by side.
  [[nodiscard]] constexpr std::size_t block(int column, int part, bool dual_return) const noexcept {
    const int pairs_before = column / 2 * blocks_per_column + part;
    return static_cast<std::size_t>(dual_return ? 2 * pairs_before + column % 2
                                                : column * blocks_per_column + part);
  }
  /// How far the head may rotate in a column: at 30 turns a second. They spin at 5 to 20.
  [[nodiscard]] constexpr int most_step_cdeg() const noexcept {
    return static_cast<int>(std::int64_t{36'000} * 30 * column_ns / 1'000'000'000) + 1;
  }
};

/// How far the head rotates from firing to firing, ticks, given its way from a packet's first
/// firing to its last, of `firings` > 1.
[[nodiscard]] constexpr std::int32_t mean_step_ticks(std::int32_t advance_cdeg,
                                                     int firings) noexcept {
  return advance_cdeg * packet::kTicksPerCdeg / (firings - 1);
}
/// The same where there is one firing a packet, and none before it: that of 10 turns a second.
[[nodiscard]] constexpr std::int32_t assumed_step_ticks(const PacketLayout& layout) noexcept {
  return static_cast<std::int32_t>(std::int64_t{packet::kRevolution_ticks} * 10 * layout.column_ns /
                                   1'000'000'000);
}

/// How far the head has rotated since its column's azimuth when a group of channels fires, ticks.
template <class Model>
[[nodiscard]] constexpr std::int32_t advance_ticks(std::int32_t step_ticks,
                                                   std::size_t group) noexcept {
  return static_cast<std::int32_t>(std::int64_t{step_ticks} * Model::group_ns(group) /
                                   Model::kLayout.column_ns);
}

/// Backwards, from column to column.
inline constexpr int kMaxJitter_cdeg = 5;
/// From the first column to the last, a column; below, the head stands still.
inline constexpr int kMinStep_cdeg = 2;

}  // namespace terracut::velodyne
