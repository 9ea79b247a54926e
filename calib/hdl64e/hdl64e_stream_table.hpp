// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Size in bytes of the table that an HDL-64E S2/S3 sends, one status byte a packet: 260 groups of
/// 7.
inline constexpr std::size_t kStreamTableBytes = 1820;

/// The unit's return setting as the table states it.
enum class ReturnSetting : std::uint8_t { kStrongest = 0, kLast = 1, kBoth = 2 };

/// How a table proves that it is whole.
enum class StreamTableCheck : std::uint8_t {
  kCrc,           ///< The CRC-16 fits (S3): one round is enough.
  kLengthMarker,  ///< The last bytes hold 1820 (S2): compare two rounds before believing it.
};

/// Parses a whole table, which begins with "UNIT#"; the result is validated, its origin "packet
/// stream". Two-point corrections count as present where X or Y is not zero and differs from far.
/// Start-up only (allocates); not for the receive thread. kMalformed, with the first fault found:
/// the table does not begin with "UNIT#", a laser number is not in its place, the CRC does not fit,
/// or the calibration fails validate(). The unit's other settings in the table (manual Rev K,
/// appendix E) are not read.
[[nodiscard]] Expected<Hdl64eCalibration> parse_stream_table(
    std::span<const std::uint8_t, kStreamTableBytes> bytes);

/// Makes a table, for the simulator and tests. Values are rounded to the stream's units (0.01 deg,
/// 1 mm, focal slope 0.1). The table states the return setting, no calibration date, and 0 for all
/// else. kInvalidArgument when a value does not fit in its field (16 bit: 32.767 m) or the
/// calibration fails validate().
[[nodiscard]] Expected<std::array<std::uint8_t, kStreamTableBytes>> make_stream_table(
    const Hdl64eCalibration& calibration, ReturnSetting setting = ReturnSetting::kStrongest,
    StreamTableCheck check = StreamTableCheck::kCrc);

/// Returns the table's CRC-16 over the 20 bytes after each laser number (64 x 20 bytes): polynomial
/// 0x8005, start 0, most significant bit first, nothing inverted (HDL-64E S3 manual Rev K p. 39).
/// Does not allocate: a status reader may test a table on any thread.
[[nodiscard]] std::uint16_t stream_table_crc(
    std::span<const std::uint8_t, kStreamTableBytes> bytes) noexcept;

}  // namespace terracut::hdl64e
