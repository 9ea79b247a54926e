// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <vector>

#include "calib/beams/beam.hpp"
#include "calib/velodyne/velodyne_calibration.hpp"

namespace terracut::velodyne {

/// Raw counts to metres and back for a model with a built-in table, in double: what the simulator
/// and the encoder invert (the formula: firmware_io/velodyne/point_kernel.hpp).
///
/// All functions: `channel` >= 0; lasers that fire more than once a column have several channels,
/// laser = `channel` % lasers. `azimuth_rad` is the head's azimuth when it fires, clockwise from
/// straight ahead seen from above, any revolution. Immutable, so any thread may call them; no
/// allocation, no locks.
class VelodyneGeometry {
 public:
  VelodyneGeometry(const VelodyneCalibration& calibration, double metres_per_count);

  /// Where a return lies. `raw_counts` is not restricted to whole counts; 0 is not treated as "no
  /// return".
  [[nodiscard]] beams::Point point(int channel, double azimuth_rad,
                                   double raw_counts) const noexcept;

  /// The beam: every point() of the channel lies on it.
  [[nodiscard]] beams::Ray ray(int channel, double azimuth_rad) const noexcept;

  /// The raw counts, not rounded, for which |point()| == range_m to within 1e-9 m; nothing when
  /// they are outside [1, 65535].
  [[nodiscard]] std::optional<double> raw_for_range(int channel, double azimuth_rad,
                                                    double range_m) const noexcept;

  /// The raw counts, not rounded, for which point() lies on the plane through `hit` with `normal`
  /// (any length) to within 1e-9 m; nothing when they are outside [1, 65535] or the beam runs along
  /// the plane.
  [[nodiscard]] std::optional<double> raw_on_plane(int channel, double azimuth_rad,
                                                   const beams::Point& hit,
                                                   const beams::Direction& normal) const noexcept;

 private:
  struct Beam {
    double offset_rad = 0, cos_elevation = 1, sin_elevation = 0, vert_offset_m = 0;
  };

  double metres_per_count_;
  std::vector<Beam> beams_;  ///< One beam a laser.
};

}  // namespace terracut::velodyne
