// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "rt/error.hpp"

namespace terracut::ruby128 {

inline constexpr int kRuby128Lasers = 128;
/// Metres per count of the wire's distance (RS-Ruby user manual).
inline constexpr double kRuby128MetresPerCount = 0.005;
/// The lens sits ahead of the axis of rotation, in the direction of the head
/// (docs/reference/sensors.md).
inline constexpr double kRuby128LensAhead_m = 0.03615;

/// The direction of one channel of an RS-Ruby128 (docs/reference/sensors.md).
struct Ruby128Channel {
  double elevation_rad = 0;       ///< "Vertical angle"; positive is up.
  double azimuth_offset_rad = 0;  ///< "Horizontal angle": added to the head's azimuth; clockwise.

  bool operator==(const Ruby128Channel&) const = default;
};

/// The calibration of one RS-Ruby128 unit: 128 channels by their number on the wire. Channel
/// numbers are NOT in order of elevation; rows are unevenly spaced, 0.1 to 5.4 degrees apart.
struct Ruby128Calibration {
  std::array<Ruby128Channel, kRuby128Lasers> channels{};
  std::string origin;    ///< For logs: "angle.csv", "DIFOP packets", "nominal table".
  bool nominal = false;  ///< The model's table, not the unit's: every summary must warn of it.
};

/// Returns the angle rounded to the unit of angle.csv, thousandths of a degree; the smallest int64
/// if it is not finite or beyond any angle.
[[nodiscard]] std::int64_t angle_mdeg(double rad) noexcept;

/// Returns the angle rounded to DIFOP's unit, hundredths of a degree. Rounds angle_mdeg()'s result,
/// halves away from zero, so that a table gives the same hundredths before and after a file:
/// -13.565 degrees are -1357, whatever their last bit in radians.
[[nodiscard]] std::int64_t angle_cdeg(double rad) noexcept;

/// Checks that this is a plausible RS-Ruby128 table: every value finite; 128 elevations distinct in
/// hundredths of a degree, not in monotonous order of channels, the lowest within 1 degree of -25,
/// the highest within 1 degree of +15; azimuth offsets of at most 10 degrees and not all within 5.
/// The error names the channel by the maker's number (1 to 128), the value and the allowed span:
/// kMalformed, or kUnsupported for the table of a Ruby Plus, which passes these checks.
[[nodiscard]] Status validate(const Ruby128Calibration& calibration);

/// Returns a 64-bit fingerprint of all angles (not of the origin), rounded by angle_cdeg(), so that
/// the same table gives the same hash from a file and from DIFOP.
[[nodiscard]] std::uint64_t fingerprint(const Ruby128Calibration& calibration);

/// Returns the row of every channel in the range image: row 0 is the lowest elevation, row 127 the
/// highest. Channels of equal elevation keep their order.
[[nodiscard]] std::array<int, kRuby128Lasers> rows_by_elevation(
    const Ruby128Calibration& calibration);

}  // namespace terracut::ruby128
