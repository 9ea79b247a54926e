// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Size in bytes of the table that an HDL-64E S2 or S3 sends, one status byte in each packet: 260
/// groups of 7 bytes.
inline constexpr std::size_t kStreamTableBytes = 1820;

/// The return setting of the unit, as its table states it.
enum class ReturnSetting : std::uint8_t { kStrongest = 0, kLast = 1, kBoth = 2 };

/// How a reader can tell that it has received a whole table.
enum class StreamTableCheck : std::uint8_t {
  kCrc,           ///< The CRC-16 is right (S3): one copy of the table is enough.
  kLengthMarker,  ///< The last bytes hold 1820 (S2): compare two copies before believing them.
};

/// Parses a whole table; the result is validated, its origin "packet stream". Two-point corrections
/// count as present where X or Y is not zero and differs from far. Fails with kMalformed, naming
/// the first fault found: the table does not begin with "UNIT#", a laser number is not in its
/// place, the CRC is wrong, or the calibration fails validate(). The table's other settings (manual
/// Rev K, appendix E) are not read. Start-up only (allocates); not for the receive thread.
[[nodiscard]] Expected<Hdl64eCalibration> parse_stream_table(
    std::span<const std::uint8_t, kStreamTableBytes> bytes);

/// Makes a table, for the simulator and tests. Values are rounded to the stream's units (0.01 deg,
/// 1 mm, focal slope 0.1). The table states `setting`, no calibration date, and 0 for all else.
/// Fails with kInvalidArgument if a value does not fit its field (16 bit: 32.767 m) or the
/// calibration fails validate().
[[nodiscard]] Expected<std::array<std::uint8_t, kStreamTableBytes>> make_stream_table(
    const Hdl64eCalibration& calibration, ReturnSetting setting = ReturnSetting::kStrongest,
    StreamTableCheck check = StreamTableCheck::kCrc);

/// Returns the CRC-16 of a table over the 20 bytes after each laser number (64 x 20 bytes):
/// polynomial 0x8005, start 0, most significant bit first, nothing inverted (HDL-64E S3 manual Rev
/// K p. 39). Does not allocate, so any thread may call this.
[[nodiscard]] std::uint16_t stream_table_crc(
    std::span<const std::uint8_t, kStreamTableBytes> bytes) noexcept;

}  // namespace terracut::hdl64e
