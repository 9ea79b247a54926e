// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Bytes of the table that an HDL-64E S2/S3 sends one status byte a packet: 260 groups of 7.
inline constexpr std::size_t kStreamTableBytes = 1820;

/// Return setting of the unit, as sent.
enum class ReturnSetting : std::uint8_t { kStrongest = 0, kLast = 1, kBoth = 2 };

/// What the table says of the unit beside the lasers (HDL-64E S3 manual Rev K, appendix E). Raw
/// bytes where the meaning differs between firmwares.
struct UnitInfo {
  struct CalibrationDate {
    int year = 0;  ///< 2000..2254
    int month = 0, day = 0, hour = 0, minute = 0, second = 0;
    bool operator==(const CalibrationDate&) const = default;
  };

  std::optional<CalibrationDate>
      calibration_date;  ///< Absent when the unit has none (0xFF or zero).
  int humidity_percent = 0;
  int upper_noise_threshold = 0;  ///< 0..255
  int lower_noise_threshold = 0;  ///< 0..255
  int motor_rpm = 0;              ///< -32768..32767
  int fov_start_cdeg = 0;         ///< 0..65535, 0.01 deg
  int fov_end_cdeg = 0;
  int hours_run = 0;  ///< 0..65535
  std::array<std::uint8_t, 4> source_ip{};
  std::array<std::uint8_t, 4> destination_ip{};
  std::uint8_t return_setting = 0;       ///< As ReturnSetting; units may send other values.
  std::uint8_t reserved_or_warning = 0;  ///< S3: reserved. S2: warning bits.
  std::uint8_t power_level = 0;          ///< 0xA0 + n fixed, 0xA8 automatic.
  /// Bit 0 lens dirty, 1 above 58 deg C, 2 below 5 deg C, 5 PPS present, 6 GPS time present (S3);
  /// from the groups between the lasers, where each repeats it: all of them or-ed.
  std::uint8_t warning_bits = 0;

  bool operator==(const UnitInfo&) const = default;
};

/// How far the table vouches for itself.
enum class StreamTableCheck : std::uint8_t {
  kCrc,           ///< The CRC-16 fits (S3): one round is enough.
  kLengthMarker,  ///< The last bytes hold 1820 (S2): compare two rounds before believing it.
};

struct StreamTable {
  Hdl64eCalibration calibration;  ///< Validated; origin "packet stream".
  UnitInfo unit;
  StreamTableCheck check = StreamTableCheck::kCrc;
};

/// Reads a whole table, beginning with "UNIT#". Two-point corrections count as present where X or Y
/// is not zero and differs from far. Start-up only (allocates); not for the receive thread.
/// kMalformed, with the first thing found wrong, when the table does not begin with "UNIT#", a
/// laser number is not in its place, the CRC does not fit, or the calibration does not pass
/// validate().
[[nodiscard]] Expected<StreamTable> parse_stream_table(
    std::span<const std::uint8_t, kStreamTableBytes> bytes);

/// The same table made from its contents, for the simulator and tests. Values are rounded to the
/// stream's units (0.01 deg, 1 mm, focal slope 0.1). kInvalidArgument when one does not fit in its
/// field (16 bit: 327.67 deg, 32.767 m) or the calibration does not pass validate().
[[nodiscard]] Expected<std::array<std::uint8_t, kStreamTableBytes>> make_stream_table(
    const Hdl64eCalibration& calibration, const UnitInfo& unit,
    StreamTableCheck check = StreamTableCheck::kCrc);

/// The table's own CRC-16 over the 20 bytes after each laser number (64 x 20 bytes): polynomial
/// 0x8005, start 0, most significant bit first, nothing inverted (HDL-64E S3 manual Rev K p. 39).
/// noexcept and without allocation, so that a status reader may test a table on any thread.
[[nodiscard]] std::uint16_t stream_table_crc(
    std::span<const std::uint8_t, kStreamTableBytes> bytes) noexcept;

}  // namespace terracut::hdl64e
