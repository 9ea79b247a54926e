// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "calib/mount/mount.hpp"
#include "rt/error.hpp"

namespace terracut::mount {

/// What is asked of the ground before a mount is read off it.
struct MountEstimateConfig {
  double near_m = 3.0;        ///< Points nearer than this, horizontally, may be the vehicle itself.
  double far_m = 25.0;        ///< ... up to which the ground is taken to be a plane.
  double min_height_m = 0.3;  ///< Sensor heights searched; (0, max_height_m).
  double max_height_m = 4.0;  ///< (min_height_m, 6)
  double max_tilt_rad = 0.26;     ///< Steepest plane searched, 15 deg.
  double inlier_m = 0.10;         ///< Half thickness of the plane while searching.
  double min_inlier_share = 0.2;  ///< Of the points between near_m and far_m.
  std::size_t min_points = 500;   ///< Between near_m and far_m.
  int candidates = 2000;          ///< Finds a plane holding 20 % of the points with 1 - 1e-7.
};

struct MountEstimate {
  Mount mount;
  double inlier_share = 0;  ///< Of the points used, those within inlier_m of the plane.
  double rms_m = 0;         ///< Of the distances of the points nearest the plane, fitted at last.
  std::size_t points_used = 0;  ///< Those between near_m and far_m.
};

/// The mount that makes the ground plane of recorded frames level and at height zero. `points` are
/// of the sensor frame (calib/mount/mount.hpp), of one or several frames; points that are not
/// finite are left out. Deterministic: the same points give the same mount. Start-up only:
/// allocates.
///
/// On a sloped or crowned road the estimate is that of the sensor over the road just there, so take
/// frames from a level, open place. kMalformed when there are too few points or no plane holds the
/// share asked for; the message says which and what was found.
[[nodiscard]] Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points,
                                                     const MountEstimateConfig& config = {});

}  // namespace terracut::mount
