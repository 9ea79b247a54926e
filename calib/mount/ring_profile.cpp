// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/ring_profile.hpp"

#include <cmath>
#include <limits>

#include "calib/ruby128/ruby128_geometry.hpp"

namespace terracut::mount {
namespace {

/// A ring whose beam starts `origin_height_m` above the sensor's origin. `past_axis(d)` is how far
/// from the axis of rotation the beam is after the horizontal distance d from its start.
template <class PastAxis>
Ring ring_past_axis(double elevation_rad, double origin_height_m, const Mount& mount,
                    double range_limit_m, const PastAxis& past_axis) {
  const double along_m = (mount.height_m + origin_height_m) / std::tan(-elevation_rad);
  const double distance_m = past_axis(along_m);
  const bool reaches = elevation_rad < 0 && along_m > 0 && distance_m <= range_limit_m;
  return {elevation_rad, origin_height_m,
          reaches ? distance_m : std::numeric_limits<double>::infinity()};
}

}  // namespace

Ring ring(double elevation_rad, double origin_height_m, const Mount& mount, double range_limit_m) {
  return ring_past_axis(elevation_rad, origin_height_m, mount, range_limit_m,
                        [](double along_m) { return along_m; });
}

RingProfile ring_profile(const hdl64e::Hdl64eCalibration& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_by_elevation(calibration);
  RingProfile profile{std::vector<Ring>(rows.size()), mount};
  for (std::size_t laser = 0; laser < rows.size(); ++laser) {
    profile.rings[static_cast<std::size_t>(rows[laser])] =
        ring(calibration.lasers[laser].vert_correction_rad, calibration.lasers[laser].vert_offset_m,
             mount, range_limit_m);
  }
  return profile;
}

RingProfile ring_profile(const ruby128::Ruby128Calibration& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_by_elevation(calibration);
  RingProfile profile{std::vector<Ring>(rows.size()), mount};
  for (std::size_t channel = 0; channel < rows.size(); ++channel) {
    const double offset_rad = calibration.channels[channel].azimuth_offset_rad;
    profile.rings[static_cast<std::size_t>(rows[channel])] = ring_past_axis(
        calibration.channels[channel].elevation_rad, 0.0, mount, range_limit_m,
        [&](double along_m) {
          return std::hypot(along_m * std::cos(offset_rad) + ruby128::kRuby128LensAhead_m,
                            along_m * std::sin(offset_rad));
        });
  }
  return profile;
}

RingProfile ring_profile(const velodyne::VelodyneCalibration& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_by_elevation(calibration);
  RingProfile profile{std::vector<Ring>(rows.size()), mount};
  for (std::size_t laser = 0; laser < rows.size(); ++laser) {
    profile.rings[static_cast<std::size_t>(rows[laser])] =
        ring(calibration.lasers[laser].elevation_rad, calibration.lasers[laser].vert_offset_m,
             mount, range_limit_m);
  }
  return profile;
}

}  // namespace terracut::mount
