// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "calib/beams/angle.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"

namespace terracut::synthetic {

/// Rings from +2 to -24.8 degrees, as an HDL-64E has them, with both blocks' vertical offsets.
inline scan::RingTable table() {
  scan::RingTable rings(scan::kScanRings);
  for (int ring = 0; ring < scan::kScanRings; ++ring) {
    const double elevation_deg = ring < 32 ? 2.0 - ring / 3.0 : -8.9 - (ring - 32) * 0.51;
    rings[static_cast<std::size_t>(ring)] = {beams::deg_to_rad(elevation_deg),
                                             ring < 32 ? 0.2 : 0.12};
  }
  return rings;
}

struct World {
  double ground_m = -1.73;  ///< Height of flat ground in the sensor frame.
  int points_per_ring = 2000;
  double first_azimuth_deg = 0.05;  ///< Counter-clockwise from straight ahead.
};

/// Horizontal distance at which a ring meets the world at an azimuth: ground, or walls between 6
/// and 48 metres that make every ring see several distances.
inline double distance_m(const World& world, const scan::RingLine& ring, double azimuth_rad) {
  const double wall_m = 27 + 21 * std::sin(5 * azimuth_rad) * std::cos(2 * azimuth_rad);
  const double slope = std::tan(ring.elevation_rad);
  const double near_wall_m = std::sin(11 * azimuth_rad) > 0.6 ? 3.1 : 1e9;
  const double ground_m = slope < 0 ? (world.ground_m - ring.vert_offset_m) / slope : 1e9;
  return std::min({wall_m, ground_m, near_wall_m});
}

/// One frame in KITTI's order: rings from the top, each counter-clockwise from straight ahead.
inline std::vector<scan::ScanPoint> scan(const scan::RingTable& rings, const World& world = {}) {
  std::vector<scan::ScanPoint> points;
  for (const scan::RingLine& ring : rings) {
    for (int i = 0; i < world.points_per_ring; ++i) {
      const double azimuth =
          beams::deg_to_rad(world.first_azimuth_deg + 360.0 * i / world.points_per_ring);
      const double d = distance_m(world, ring, azimuth);
      points.push_back({static_cast<float>(d * std::cos(azimuth)),
                        static_cast<float>(d * std::sin(azimuth)),
                        static_cast<float>(ring.vert_offset_m + d * std::tan(ring.elevation_rad)),
                        static_cast<float>(i % 100) / 100.0F});
    }
  }
  return points;
}

/// Removes the points of one ring.
inline void erase_ring(std::vector<scan::ScanPoint>& points, int ring, const World& world = {}) {
  const auto first = points.begin() + std::ptrdiff_t{ring} * world.points_per_ring;
  points.erase(first, first + world.points_per_ring);
}

/// What is left of a scan, in order, when only the azimuths for which `keep` is true are kept;
/// degrees counter-clockwise from straight ahead, -180..180.
template <class Keep>
std::vector<scan::ScanPoint> cropped(const std::vector<scan::ScanPoint>& points, Keep&& keep) {
  std::vector<scan::ScanPoint> kept;
  std::copy_if(points.begin(), points.end(), std::back_inserter(kept),
               [&](const scan::ScanPoint& p) {
                 return keep(beams::rad_to_deg(std::atan2(double{p.y_m}, double{p.x_m})));
               });
  return kept;
}

}  // namespace terracut::synthetic
