// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/hdl64e/status_cycle.hpp"
#include "firmware_io/hdl64e/status_position.hpp"
#include "firmware_io/hdl64e/status_table_collector.hpp"

namespace terracut::hdl64e {

/// What the unit last said of itself; nothing where it has not yet.
struct StatusSnapshot {
  std::optional<GpsState> gps;  ///< As sent; a unit may send values that GpsState does not name.
  /// Date and time, only from six bytes of one cycle that make a date; units without GPS send none.
  std::optional<DateTime> time;
  std::uint32_t time_stamp_us = 0;  ///< Device stamp of the first packet of the cycle of `time`.
  std::optional<std::int8_t> temperature_deg_c;
  std::optional<std::uint8_t> firmware;  ///< As sent.
  /// Bit 0 lens dirty, 1 above 58 deg C, 2 below 5 deg C, 5 PPS present, 6 GPS time present; S2: 3
  /// voltage low, 4 voltage high, and known only once its table is accepted.
  std::optional<std::uint8_t> warning_bits;
  std::optional<StatusFlavour>
      flavour;  ///< kS3 once a 'W' was seen, else kS2 once a table was accepted.
};

struct StatusCounters {
  std::uint64_t packets = 0;
  std::uint64_t rounds = 0;          ///< Ends of a round passed, with holes or without.
  std::uint64_t refused_by_crc = 0;  ///< Whole tables that failed their CRC.
  std::uint64_t refused_by_laser_numbers = 0;
  std::uint64_t restarts = 0;  ///< Packet count lost (gap, clock jump): collecting began anew.
  std::uint64_t unplaced = 0;  ///< Repeated packets, and packets before the count was known.
};

/// Reads the status stream of an HDL-64E (S2, S2.1, S3) from the last bytes of its packets: state,
/// date and time, and the 1820-byte table with the calibration, which takes 4160 packets (1.2 s
/// single, 0.7 s dual return) to go round. Lost packets leave holes that the next round fills;
/// repeated and reordered packets are put right.
///
/// For one unit; one thread at a time. add() is real-time safe: no allocation, lock or exception; a
/// few nanoseconds, and about ten microseconds in the packet that ends a round with news.
class StatusStreamReader {
 public:
  void add(std::uint8_t type, std::uint8_t value, std::uint32_t device_stamp_us) noexcept;

  /// Resets everything, the accepted table included.
  void reset() noexcept { *this = StatusStreamReader{}; }

  [[nodiscard]] const StatusSnapshot& latest() const noexcept { return latest_; }
  [[nodiscard]] const StatusCounters& counters() const noexcept { return counters_; }

  /// Bytes of the table not yet seen; all 1820 while its beginning has not come by.
  [[nodiscard]] std::size_t holes() const noexcept { return collector_.holes(); }

  /// A whole table was accepted: by its CRC (S3), or since two rounds agreed (S2).
  [[nodiscard]] bool has_table() const noexcept { return collector_.accepted(); }
  /// The newest accepted table, for parse_stream_table() (not on the receive thread); zeros
  /// before has_table().
  [[nodiscard]] std::span<const std::uint8_t, kStreamTableBytes> table() const noexcept {
    return collector_.table();
  }
  /// Counts accepted tables whose laser bytes differ from the one before; 0 before the first.
  [[nodiscard]] std::uint32_t table_generation() const noexcept { return collector_.generation(); }

  /// Mean device time between packets, which tells the return mode; 0 while unknown.
  [[nodiscard]] double packet_period_us() const noexcept { return position_.period_us(); }

 private:
  void read_letter(std::int64_t cycle, int place, std::uint8_t value,
                   std::uint32_t stamp_us) noexcept;
  void read_table_byte(std::int64_t cycle, int place, std::uint8_t value) noexcept;
  void try_accept() noexcept;
  void begin_anew() noexcept;

  StatusPosition position_;
  StatusTableCollector collector_;
  StatusSnapshot latest_;
  StatusCounters counters_;

  bool warning_type_seen_ = false;
  std::int64_t newest_cycle_ = 0;
  std::int64_t time_cycle_ = -1;
  std::uint32_t time_stamp_us_ = 0;
  unsigned time_places_ = 0;  ///< Bit per place 0..5 that has come in time_cycle_.
  std::array<std::uint8_t, 6> time_bytes_{};
};

}  // namespace terracut::hdl64e
