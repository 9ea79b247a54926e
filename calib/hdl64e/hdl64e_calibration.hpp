// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "rt/error.hpp"

namespace terracut::hdl64e {

inline constexpr int kHdl64eLasers = 64;

/// The factory correction of one laser (HDL-64E S3 manual Rev K, p. 10; docs/reference/sensors.md).
struct Hdl64eLaser {
  double rot_correction_rad = 0;   ///< rho, subtracted from the azimuth; positive is to the left.
  double vert_correction_rad = 0;  ///< omega, the elevation of the beam; positive is up.
  double dist_correction_m = 0;    ///< Added to a raw distance of about 25.04 m ("far").
  double dist_correction_x_m = 0;  ///< Replaces dist_correction_m along x at 2.40 m if two_point.
  double dist_correction_y_m = 0;  ///< Replaces dist_correction_m along y at 1.93 m if two_point.
  double vert_offset_m = 0;        ///< Height of the beam's start above the sensor's origin.
  double horiz_offset_m = 0;       ///< Sideways offset of the beam's start.
  double focal_distance_m = 0;     ///< Distance of the strongest return, for the intensity formula.
  double focal_slope = 0;
  int min_intensity = 0;    ///< Lowest intensity, 0 to 255.
  int max_intensity = 255;  ///< Highest intensity, min_intensity to 255.
  bool two_point = false;   ///< True if X and Y corrections are present and must be used.

  bool operator==(const Hdl64eLaser&) const = default;
};

/// The calibration of one HDL-64E unit: 64 lasers by their number on the wire (0..31 in blocks
/// 0xEEFF, 32..63 in blocks 0xDDFF). Laser numbers are NOT in order of elevation.
struct Hdl64eCalibration {
  std::array<Hdl64eLaser, kHdl64eLasers> lasers{};
  double distance_resolution_m = 0.002;  ///< Metres per count of the raw distance.
  /// Where the table comes from, for logs: "drive.calibration.xml", "packet stream".
  std::string origin;
};

/// True if these distance corrections mean two-point correction: X or Y was measured (is not zero)
/// and differs from `far_m`. No field of the files tells this reliably.
[[nodiscard]] constexpr bool two_point_present(double far_m, double x_m, double y_m) noexcept {
  return (x_m != 0 && x_m != far_m) || (y_m != 0 && y_m != far_m);
}

/// Checks that `calibration` is a plausible HDL-64E table: all values are finite; angles, offsets
/// and corrections lie in the spans seen on real units (docs/reference/sensors.md); elevations are
/// distinct enough for 64 rows. The error names the laser, the field, the value and the allowed
/// span.
[[nodiscard]] Status validate(const Hdl64eCalibration& calibration);

/// Returns a 64-bit fingerprint of all values (not of `origin`), rounded to the packet stream's
/// units, so that a unit's table gives the same fingerprint from a file and from the stream.
[[nodiscard]] std::uint64_t fingerprint(const Hdl64eCalibration& calibration);

/// Returns the range image row of each laser: row 0 has the lowest elevation (nearest to the
/// vehicle), row 63 the highest. Lasers of equal elevation keep their order.
[[nodiscard]] std::array<int, kHdl64eLasers> rows_by_elevation(
    const Hdl64eCalibration& calibration);

}  // namespace terracut::hdl64e
