// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "calib/beams/straight_geometry.hpp"
#include "calib/ouster/ouster_calibration.hpp"

namespace terracut::ouster {

/// Converts ranges in counts to points in the frame of a unit (not of its rotating lidar), in
/// double, and back, as beams::StraightGeometry does. The azimuth is the head's, clockwise from
/// where the connector points. Immutable, so any thread may call them; too slow for the per-packet
/// path.
class OusterGeometry {
 public:
  OusterGeometry(const OusterCalibration& unit, double metres_per_count);

  /// Returns the beam on which every point() of `laser` lies.
  [[nodiscard]] beams::Ray ray(int laser, double azimuth_rad) const noexcept;
  /// Returns the point of a return. `counts` need not be whole.
  [[nodiscard]] beams::Point point(int laser, double azimuth_rad, double counts) const noexcept;
  /// Returns the counts, not rounded, for which point() lies on the plane through `hit` with
  /// `normal`; nothing if there are none.
  [[nodiscard]] std::optional<double> raw_on_plane(int laser, double azimuth_rad,
                                                   const beams::Point& hit,
                                                   const beams::Direction& normal) const noexcept;

 private:
  beams::StraightGeometry of_lidar_;
  std::array<double, 12> T_sensor_lidar_;
  double origin_counts_;  ///< Ranges count from this far behind the beams' beginning.
};

}  // namespace terracut::ouster
