// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "calib/beams/beam_table.hpp"
#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/mount.hpp"
#include "calib/ouster/ouster_calibration.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::mount {

/// One row of the range image as the pipeline needs it: one laser; rows ascend in elevation.
struct Ring {
  /// Elevation of the beam in the sensor frame, negated if the sensor is upside down.
  double elevation_rad = 0;
  double origin_height_m = 0;  ///< Height of the beam's start above the sensor's origin.
  /// Mean horizontal distance at which the beam meets the mount's ground plane; the least distance
  /// for a tilted sensor upside down. Infinity if the beam never meets the ground (elevation at or
  /// above the horizon) or only beyond the range limit.
  double ground_distance_m = 0;
};

/// The paper's calibrated "average distance between the points of a laser and the origin", from
/// which the ring grid's boundaries and the thresholds of Eq. 5 follow. rings[0] is the lowest
/// elevation.
struct RingProfile {
  std::vector<Ring> rings;
  Mount mount;
};

/// Returns the ring, over level ground, of a beam that starts on the axis of rotation. `mount` may
/// hold the sensor upside down. A beam that reaches the ground only beyond `range_limit_m` counts
/// as never reaching it.
[[nodiscard]] Ring ring(double elevation_rad, double origin_height_m, const Mount& mount,
                        double range_limit_m = 120.0);

/// Returns the profile computed from the calibration alone, for a level mount. A beam that reaches
/// the ground only beyond `range_limit_m` counts as never reaching it.
[[nodiscard]] RingProfile ring_profile(const hdl64e::Hdl64eCalibration& calibration,
                                       const Mount& mount, double range_limit_m = 120.0);
[[nodiscard]] RingProfile ring_profile(const ruby128::Ruby128Calibration& calibration,
                                       const Mount& mount, double range_limit_m = 120.0);
[[nodiscard]] RingProfile ring_profile(const beams::BeamTable& calibration, const Mount& mount,
                                       double range_limit_m = 120.0);
[[nodiscard]] RingProfile ring_profile(const ouster::OusterCalibration& calibration,
                                       const Mount& mount, double range_limit_m = 120.0);

}  // namespace terracut::mount
