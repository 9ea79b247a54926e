// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "calib/hdl64e/hdl64e_stream_table.hpp"
#include "firmware_io/hdl64e/status_cycle.hpp"

namespace terracut::tables {

/// The values that a unit reports beside its table.
struct StatusValues {
  std::uint8_t gps = 0;  ///< 'A' PPS and NMEA, 'V' NMEA only, 'P' PPS only, 0 none.
  std::int8_t temperature_deg_c = 35;
  std::uint8_t firmware = 0x40;
};

/// Makes the status bytes of successive packets as a unit does, for the encoder, the simulator and
/// tests. Allocates nothing; may be used on the packet path.
class StatusStreamWriter {
 public:
  /// `table` is made by hdl64e::make_stream_table() (kCrc for an S3, kLengthMarker for an S2) and
  /// copied.
  StatusStreamWriter(std::span<const std::uint8_t, hdl64e::kStreamTableBytes> table,
                     hdl64e::StatusFlavour flavour, StatusValues values = {}) noexcept;

  /// Returns the two status bytes of the next packet. `stamp_ns` (since 1970, UTC) is sent as date
  /// and time. It is sampled at the start of a cycle, so that the six bytes belong together. Years
  /// 2000..2255.
  [[nodiscard]] hdl64e::StatusPair next(std::int64_t stamp_ns) noexcept;

 private:
  [[nodiscard]] hdl64e::StatusPair table_pair(std::size_t group, std::size_t place) const noexcept;

  std::array<std::uint8_t, hdl64e::kStreamTableBytes> table_;
  hdl64e::StatusFlavour flavour_;
  StatusValues values_;
  std::uint32_t packet_ = 0;            ///< Index of the packet, 0 .. kStatusRoundPackets - 1
  std::array<std::uint8_t, 6> time_{};  ///< Hour, minute, second, day, month, year since 2000.
};

}  // namespace terracut::tables
