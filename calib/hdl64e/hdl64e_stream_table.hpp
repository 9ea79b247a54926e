// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Bytes of the table that an HDL-64E S2/S3 sends one status byte a packet: 260 groups of 7.
inline constexpr std::size_t kStreamTableBytes = 1820;

/// Return setting of the unit, as the table has it beside the lasers.
enum class ReturnSetting : std::uint8_t { kStrongest = 0, kLast = 1, kBoth = 2 };

/// How far the table vouches for itself.
enum class StreamTableCheck : std::uint8_t {
  kCrc,           ///< The CRC-16 fits (S3): one round is enough.
  kLengthMarker,  ///< The last bytes hold 1820 (S2): compare two rounds before believing it.
};

/// The calibration of a whole table, beginning with "UNIT#"; validated, origin "packet stream".
/// Two-point corrections count as present where X or Y is not zero and differs from far. Start-up
/// only (allocates); not for the receive thread. kMalformed, with the first thing found wrong, when
/// the table does not begin with "UNIT#", a laser number is not in its place, the CRC does not fit,
/// or the calibration does not pass validate(). What the table says of the unit beside its lasers
/// (HDL-64E S3 manual Rev K, appendix E) is not read.
[[nodiscard]] Expected<Hdl64eCalibration> parse_stream_table(
    std::span<const std::uint8_t, kStreamTableBytes> bytes);

/// A table, for the simulator and tests. Values are rounded to the stream's units (0.01 deg, 1 mm,
/// focal slope 0.1); beside the lasers it says how the unit is set, that it has no calibration
/// date, and 0 of all else. kInvalidArgument when a value does not fit in its field (16 bit:
/// 32.767 m) or the calibration does not pass validate().
[[nodiscard]] Expected<std::array<std::uint8_t, kStreamTableBytes>> make_stream_table(
    const Hdl64eCalibration& calibration, ReturnSetting setting = ReturnSetting::kStrongest,
    StreamTableCheck check = StreamTableCheck::kCrc);

/// The table's own CRC-16 over the 20 bytes after each laser number (64 x 20 bytes): polynomial
/// 0x8005, start 0, most significant bit first, nothing inverted (HDL-64E S3 manual Rev K p. 39).
/// noexcept and without allocation, so that a status reader may test a table on any thread.
[[nodiscard]] std::uint16_t stream_table_crc(
    std::span<const std::uint8_t, kStreamTableBytes> bytes) noexcept;

}  // namespace terracut::hdl64e
