// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::scan {

/// The rings of an HDL-64E in the order of KITTI files: ring 0 is the highest elevation, 63 the
/// lowest.
inline constexpr int kScanRings = hdl64e::kHdl64eLasers;

/// The ring of a point that is not finite or fits no ring.
inline constexpr std::int16_t kNoRing = -1;

/// One ring as a line in the vertical plane: z = vert_offset + tan(elevation) * horizontal
/// distance.
struct RingLine {
  double elevation_rad = 0;
  double vert_offset_m = 0;  ///< Height of the beam's start above the sensor's origin.

  /// Returns the point's height above the line, metres.
  [[nodiscard]] double height_above_m(const ScanPoint& p) const noexcept {
    const double distance_m = std::hypot(double{p.x_m}, double{p.y_m});
    return p.z_m - vert_offset_m - std::tan(elevation_rad) * distance_m;
  }
};

/// The rings of one unit (64 for an HDL-64E); elevations fall strictly from ring to ring.
using RingTable = std::vector<RingLine>;

/// Returns the laser number of a ring in the numbering of most units (docs/reference/sensors.md).
/// Rings 0..31 have lasers 0..31 (the upper block), rings 32..63 have lasers 32..63 (the lower
/// block), each block in interleaved groups.
[[nodiscard]] int usual_laser_of_ring(int ring) noexcept;

/// Returns the rings of a calibration, sorted by elevation; distance corrections are not used.
[[nodiscard]] RingTable ring_table(const hdl64e::Hdl64eCalibration& calibration);

/// Returns the laser of every ring, from the top: the inverse of hdl64e::rows_by_elevation().
[[nodiscard]] std::array<int, kScanRings> lasers_by_ring(
    const hdl64e::Hdl64eCalibration& calibration);

/// Returns the profile of the rings over level ground: row 0 is the lowest ring.
[[nodiscard]] mount::RingProfile ring_profile(const RingTable& table, const mount::Mount& mount);

/// Makes a calibration of 64 lasers with the rings' elevations and vertical offsets and no other
/// correction, numbered by usual_laser_of_ring().
[[nodiscard]] hdl64e::Hdl64eCalibration hdl64e_calibration(const RingTable& table);

}  // namespace terracut::scan
