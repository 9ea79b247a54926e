// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "calib/beams/beam.hpp"

namespace terracut::beams {

/// Converts raw counts to metres and back, in double, for sensors whose returns lie on straight
/// beams (all but the HDL-64E). The packet decoder's float loops are checked against this class,
/// and the simulator inverts it.
///
/// With t = the head's azimuth when the laser fires, h = its azimuth offset, v = its elevation,
/// o = its vertical offset, d = raw counts in metres, R = how far the lens is ahead of the axis of
/// rotation, in the direction of the head (docs/reference/sensors.md):
///
///   x =   d cos v cos(t + h) + R cos t
///   y = -(d cos v sin(t + h) + R sin t)
///   z =   d sin v + o
///
/// In all functions, `laser` >= 0 stands for laser number `laser` % lasers, because some lasers
/// fire more than once a column; `azimuth_rad` is the head's azimuth when the laser fires,
/// clockwise from straight ahead seen from above, any revolution. Immutable, so any thread may call
/// them; no allocation, no locks; each call computes a few trigonometric functions (too slow for
/// the per-packet path).
class StraightGeometry {
 public:
  /// Takes `lasers` from a Ruby128Calibration or a beams::BeamTable.
  template <class Lasers>
  StraightGeometry(const Lasers& lasers, double metres_per_count, double lens_ahead_m = 0)
      : metres_per_count_(metres_per_count), lens_ahead_m_(lens_ahead_m) {
    for (const auto& laser : lasers) {
      beams_.push_back(
          {laser.azimuth_offset_rad, std::cos(laser.elevation_rad), std::sin(laser.elevation_rad)});
      if constexpr (requires { laser.vert_offset_m; }) {
        beams_.back().vert_offset_m = laser.vert_offset_m;
      }
    }
  }

  /// Returns the beam on which every point() of `laser` lies.
  [[nodiscard]] Ray ray(int laser, double azimuth_rad) const noexcept;

  /// Returns the point of a return. `raw_counts` need not be whole; 0 is not treated as "no
  /// return".
  [[nodiscard]] Point point(int laser, double azimuth_rad, double raw_counts) const noexcept;

  /// Returns the raw counts, not rounded, for which point() lies on the plane through `hit` with
  /// `normal` (any length) to within 1e-9 m; nothing if the counts are outside [1, 65535] or the
  /// beam runs along the plane.
  [[nodiscard]] std::optional<double> raw_on_plane(int laser, double azimuth_rad, const Point& hit,
                                                   const Direction& normal) const noexcept;

 private:
  struct Beam {
    double offset_rad = 0, cos_elevation = 1, sin_elevation = 0, vert_offset_m = 0;
  };

  double metres_per_count_, lens_ahead_m_;
  std::vector<Beam> beams_;  ///< Indexed by laser.
};

}  // namespace terracut::beams
