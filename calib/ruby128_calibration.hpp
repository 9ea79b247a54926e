// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "rt/error.hpp"

namespace terracut::calib {

inline constexpr int kRuby128Lasers = 128;

/// The direction of one channel of an RS-Ruby128 (docs/sensors.md).
struct Ruby128Channel {
  double elevation_rad = 0;       ///< "Vertical angle"; positive is up.
  double azimuth_offset_rad = 0;  ///< "Horizontal angle": added to the head's azimuth; clockwise.

  bool operator==(const Ruby128Channel&) const = default;
};

/// The calibration of one RS-Ruby128 unit: 128 channels by their number on the wire. Channel
/// numbers are NOT in order of elevation, and rows are very uneven: 0.1 to 5.4 degrees apart.
struct Ruby128Calibration {
  std::array<Ruby128Channel, kRuby128Lasers> channels{};
  std::string origin;    ///< For logs: "angle.csv", "DIFOP packets", "nominal table".
  bool nominal = false;  ///< Not of a unit but of the model; every summary must warn of it.
};

/// Checks that this is a plausible RS-Ruby128 table: every value finite, elevations distinct enough
/// to form 128 rows, the lowest within 1 degree of -25 and the highest within 1 degree of +15,
/// azimuth offsets below 10 degrees. The error names the channel, the value and the allowed span.
[[nodiscard]] Status validate(const Ruby128Calibration& calibration);

/// A 64-bit fingerprint of all angles (not of the origin), rounded to DIFOP's hundredths of a
/// degree, so that the same unit's table gives the same hash from a file of that precision and from
/// DIFOP.
[[nodiscard]] std::uint64_t fingerprint(const Ruby128Calibration& calibration);

/// Row of every channel in the range image: row 0 is the lowest elevation, row 127 the highest.
/// Stable for equal elevations.
[[nodiscard]] std::array<int, kRuby128Lasers> rows_by_elevation(
    const Ruby128Calibration& calibration);

}  // namespace terracut::calib
