// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"

namespace terracut::test {

/// A sensor whose beams have no offsets: `rows` evenly spaced elevations, lowest first.
inline mount::RingProfile even_profile(int rows = 64, double lowest_deg = -24.0,
                                       double highest_deg = 2.0, double height_m = 1.73) {
  mount::RingProfile profile;
  profile.mount.height_m = height_m;
  for (int row = 0; row < rows; ++row) {
    mount::Ring ring;
    ring.elevation_rad =
        (lowest_deg + (highest_deg - lowest_deg) * row / (rows - 1)) * std::numbers::pi / 180;
    const double distance_m = height_m / std::tan(-ring.elevation_rad);
    ring.ground_distance_m = ring.elevation_rad < 0 && distance_m < 120 ? distance_m : INFINITY;
    profile.rings.push_back(ring);
  }
  return profile;
}

/// Distance along a beam (from the sensor, in the direction of azimuth and elevation) to what it
/// hits; negative or infinite for nothing.
using BeamCast = std::function<double(double azimuth_rad, double elevation_rad)>;

/// Fills `image` (cleared first) by casting one beam through the middle of every cell.
inline void cast_frame(const mount::RingProfile& profile, const BeamCast& cast,
                       frame::RangeImage& image) {
  image.clear();
  const frame::ImageShape& shape = image.shape();
  for (int row = 0; row < shape.rows; ++row) {
    const double elevation_rad = profile.rings[static_cast<std::size_t>(row)].elevation_rad;
    for (int column = 0; column < shape.columns; ++column) {
      const double azimuth_rad = 2 * std::numbers::pi * (column + 0.5) / shape.columns;
      const double d = cast(azimuth_rad, elevation_rad);
      if (!(d > 0) || d > 120) continue;
      const double across_m = d * std::cos(elevation_rad);
      image.place(row, column,
                  {static_cast<float>(across_m * std::cos(azimuth_rad)),
                   static_cast<float>(-across_m * std::sin(azimuth_rad)),
                   static_cast<float>(profile.mount.height_m + d * std::sin(elevation_rad)),
                   static_cast<float>(across_m), 0});
    }
  }
}

/// Level ground under the sensor.
inline BeamCast flat_ground(double height_m = 1.73) {
  return [height_m](double, double elevation_rad) {
    return elevation_rad < 0 ? height_m / std::sin(-elevation_rad) : -1.0;
  };
}

/// Flat ground with an upright wall across x = `x_m`, |y| <= `half_width_m`, up to `top_m`, its
/// lower edge `clearance_m` above the ground.
inline BeamCast ground_with_wall(double x_m, double half_width_m, double top_m,
                                 double clearance_m = 0, double height_m = 1.73) {
  return [=](double azimuth_rad, double elevation_rad) {
    const double ground = flat_ground(height_m)(azimuth_rad, elevation_rad);
    const double forward = std::cos(elevation_rad) * std::cos(azimuth_rad);
    if (forward <= 0) return ground;
    const double d = x_m / forward;
    const double y_m = -d * std::cos(elevation_rad) * std::sin(azimuth_rad);
    const double z_m = height_m + d * std::sin(elevation_rad);
    const bool hits = std::fabs(y_m) <= half_width_m && z_m >= clearance_m && z_m <= top_m &&
                      (ground < 0 || d < ground);
    return hits ? d : ground;
  };
}

}  // namespace terracut::test
