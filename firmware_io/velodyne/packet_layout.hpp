// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/table/column_pace.hpp"

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
  table::ColumnPace pace{};
  std::int32_t firing_ns = 0;  ///< Time from one firing of all lasers to the next.

  [[nodiscard]] constexpr int columns(bool dual_return) const noexcept {
    return dual_return ? columns_dual : kBlocks / blocks_per_column;
  }
  /// Returns the block of a column that holds its part number `part`. In dual return the two
  /// returns of a part are in adjacent blocks.
  [[nodiscard]] constexpr std::size_t block(int column, int part, bool dual_return) const noexcept {
    const int pairs_before = column / 2 * blocks_per_column + part;
    return static_cast<std::size_t>(dual_return ? 2 * pairs_before + column % 2
                                                : column * blocks_per_column + part);
  }
};

}  // namespace terracut::velodyne
