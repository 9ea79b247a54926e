// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ring_profile.hpp"

#include <cmath>
#include <limits>

namespace terracut::calib {

RingProfile ring_profile(const Hdl64eCalibration& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_by_elevation(calibration);
  RingProfile profile{std::vector<Ring>(rows.size()), mount};
  for (std::size_t laser = 0; laser < rows.size(); ++laser) {
    const double elevation_rad = calibration.lasers[laser].vert_correction_rad;
    const double origin_height_m = calibration.lasers[laser].vert_offset_m;
    const double distance_m = (mount.height_m + origin_height_m) / std::tan(-elevation_rad);
    const bool reaches = elevation_rad < 0 && distance_m > 0 && distance_m <= range_limit_m;
    profile.rings[static_cast<std::size_t>(rows[laser])] = {
        elevation_rad, origin_height_m,
        reaches ? distance_m : std::numeric_limits<double>::infinity()};
  }
  return profile;
}

}  // namespace terracut::calib
