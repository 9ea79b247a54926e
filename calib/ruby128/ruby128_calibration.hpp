// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "rt/error.hpp"

namespace terracut::ruby128 {

inline constexpr int kRuby128Lasers = 128;
/// Metres per count of distance in packets (RS-Ruby user manual).
inline constexpr double kRuby128MetresPerCount = 0.005;
/// How far the lens is ahead of the axis of rotation, in the direction of the head
/// (docs/reference/sensors.md).
inline constexpr double kRuby128LensAhead_m = 0.03615;

/// The direction of one channel of an RS-Ruby128 (docs/reference/sensors.md).
struct Ruby128Channel {
  double elevation_rad = 0;       ///< The maker's "vertical angle"; positive is up.
  double azimuth_offset_rad = 0;  ///< The maker's "horizontal angle": clockwise from the head.

  bool operator==(const Ruby128Channel&) const = default;
};

/// The calibration of one RS-Ruby128 unit: 128 channels by their number on the wire. Channel
/// numbers are NOT in order of elevation; rows are unevenly spaced, 0.1 to 5.4 degrees apart.
struct Ruby128Calibration {
  std::array<Ruby128Channel, kRuby128Lasers> channels{};
  std::string origin;  ///< Where the table comes from, for logs: "angle.csv", "DIFOP packets".
  /// True if this is the model's table instead of the unit's own: every summary must warn of it.
  bool nominal = false;
};

/// Returns the angle rounded to thousandths of a degree, the unit of angle.csv; the smallest int64
/// if the angle is not finite or absurdly large.
[[nodiscard]] std::int64_t angle_mdeg(double rad) noexcept;

/// Returns the angle rounded to hundredths of a degree, the unit of DIFOP packets. Rounds the
/// result of angle_mdeg(), halves away from zero, so that a table gives the same hundredths before
/// and after it is written to a file: -13.565 degrees are -1357, whatever their last bit in
/// radians.
[[nodiscard]] std::int64_t angle_cdeg(double rad) noexcept;

/// Checks that `calibration` is a plausible RS-Ruby128 table: every value is finite; the 128
/// elevations differ by hundredths of a degree and neither ascend nor descend throughout by
/// channel; the lowest is within 1 degree of -25, the highest within 1 degree of +15; azimuth
/// offsets are at most 10 degrees, and some exceed 5. Fails with kMalformed. A Ruby Plus would pass
/// these checks; its table is recognised separately and fails with kUnsupported. The message names
/// the channel by the maker's number (1 to 128), the value and the allowed span.
[[nodiscard]] Status validate(const Ruby128Calibration& calibration);

/// Returns a 64-bit fingerprint of all angles (not of `origin`), rounded by angle_cdeg(), so that a
/// table gives the same fingerprint from a file and from DIFOP packets.
[[nodiscard]] std::uint64_t fingerprint(const Ruby128Calibration& calibration);

/// Returns the range image row of each channel: row 0 has the lowest elevation, row 127 the
/// highest. Channels of equal elevation keep their order.
[[nodiscard]] std::array<int, kRuby128Lasers> rows_by_elevation(
    const Ruby128Calibration& calibration);

}  // namespace terracut::ruby128
