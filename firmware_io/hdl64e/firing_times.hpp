// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace terracut::hdl64e {

/// Columns of a single return packet: each is a pair of an upper and a lower block.
inline constexpr int kColumnsPerPacketSingle = 6;
/// Columns of a dual return packet: blocks 4n and 4n+1 hold the first return, 4n+2 and 4n+3 the
/// second.
inline constexpr int kColumnsPerPacketDual = 3;

/// When each laser fires, in nanoseconds. Both blocks of a pair fire together, in eight groups of
/// four lasers (HDL-64E S2 manual, firing table; S3 manual for the 57.6 us cycle).
struct FiringTimes {
  std::int32_t column_ns = 0;  ///< Time from a column's first firing to the next column's.
  std::int32_t group_ns = 0;   ///< Time from one group of four lasers to the next.
  std::array<std::int32_t, 4> in_group_ns{};  ///< Time of each firing within a group.
  std::int32_t columns_per_packet = 0;

  /// Returns the difference between device stamps of successive packets.
  [[nodiscard]] constexpr std::int32_t packet_ns() const noexcept {
    return column_ns * columns_per_packet;
  }
  /// Returns the time from the first firing of a column to the firing of `laser`, 0..31, of either
  /// block.
  [[nodiscard]] constexpr std::int32_t laser_ns(int laser) const noexcept {
    return group_ns * (laser / 4) + in_group_ns[static_cast<std::size_t>(laser % 4)];
  }
};

/// Times of S2, S2.1 and S3 in single return with the 48 us cycle: one packet in 288.0 us.
inline constexpr FiringTimes kFiringTimesSingle48{
    48'000, 6'000, {0, 1'260, 2'460, 3'660}, kColumnsPerPacketSingle};
/// Times of the S3 in single return with the 57.6 us cycle, by some sources: one packet in 345.6
/// us.
inline constexpr FiringTimes kFiringTimesSingle57{
    57'600, 7'200, {0, 1'300, 2'500, 3'700}, kColumnsPerPacketSingle};
/// Times of the S3 in dual return: one packet in 172.8 us.
inline constexpr FiringTimes kFiringTimesDual{
    57'600, 7'200, {0, 1'300, 2'500, 3'700}, kColumnsPerPacketDual};

static_assert(kFiringTimesSingle48.packet_ns() == 288'000);
static_assert(kFiringTimesSingle57.packet_ns() == 345'600);
static_assert(kFiringTimesDual.packet_ns() == 172'800);

}  // namespace terracut::hdl64e
