// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/hdl64e/status_cycle.hpp"
#include "firmware_io/hdl64e/status_position.hpp"
#include "firmware_io/hdl64e/status_table_collector.hpp"

namespace terracut::hdl64e {

/// What the unit last reported about itself; nothing where it has not reported yet.
struct StatusSnapshot {
  std::optional<std::int8_t> temperature_deg_c;
  std::optional<std::uint8_t> firmware;  ///< The version byte as sent.
  /// Bits: 0 lens dirty, 1 above 58 deg C, 2 below 5 deg C, 5 PPS present, 6 GPS time present; on
  /// an S2 also 3 voltage low, 4 voltage high. An S2's bits are known only once its table is
  /// accepted.
  std::optional<std::uint8_t> warning_bits;
};

/// Reads the status stream of an HDL-64E (S2, S2.1, S3) from the last bytes of its packets: the
/// unit's state, and the 1820-byte table with the calibration, which is sent in 4160 packets (1.2 s
/// in single, 0.7 s in dual return). Lost packets leave holes that the next round fills; repeated
/// and reordered packets are handled.
///
/// For one unit; one thread at a time. add() is real-time safe: no allocation, lock or exception;
/// it takes a few nanoseconds, and about ten microseconds for a packet that ends a round with
/// changes.
class StatusStreamReader {
 public:
  void add(std::uint8_t type, std::uint8_t value, std::uint32_t device_stamp_us) noexcept;

  [[nodiscard]] const StatusSnapshot& latest() const noexcept { return latest_; }

  /// Returns the number of bytes of the table not seen yet; 1820 until the table's beginning was
  /// seen.
  [[nodiscard]] std::size_t holes() const noexcept { return collector_.holes(); }

  /// True once a table was accepted: by its CRC (S3), or because two rounds agreed (S2).
  [[nodiscard]] bool has_table() const noexcept { return collector_.accepted(); }
  /// Returns the table accepted last, for parse_stream_table() (not on the receive thread); zeros
  /// unless has_table().
  [[nodiscard]] std::span<const std::uint8_t, kStreamTableBytes> table() const noexcept {
    return collector_.table();
  }

 private:
  void read_table_byte(std::int64_t cycle, int place, std::uint8_t value) noexcept;
  void try_accept() noexcept;
  void begin_anew() noexcept;

  StatusPosition position_;
  StatusTableCollector collector_;
  StatusSnapshot latest_;
  /// Is kS3 once a 'W' was seen, else kS2 once a table was accepted.
  std::optional<StatusFlavour> flavour_;
  bool warning_type_seen_ = false;
  std::int64_t newest_cycle_ = 0;
};

}  // namespace terracut::hdl64e
