// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/ring_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace terracut::mount {
namespace {

/// True for an upside-down sensor tilted by more than 0.05 rad: its rings meet the ground far from
/// where a level sensor's would. An upright sensor always gets a level sensor's rings, because they
/// make the better grid even if the sensor is tilted.
bool leans(const Mount& mount) noexcept {
  constexpr double kLevel_rad = 0.05;
  return is_upside_down(mount) && std::max(std::numbers::pi - std::abs(mount.roll_rad),
                                           std::abs(mount.pitch_rad)) > kLevel_rad;
}

/// Returns the smallest distance from a beam's start, over all azimuths, at which the beam meets
/// the ground; infinity if it never does.
double nearest_ground_m(double elevation_rad, double origin_height_m, const Mount& mount) {
  constexpr int kDirections = 120;
  const RigidTransform T = T_vehicle_lidar({0, mount.roll_rad, mount.pitch_rad});
  const double start_m = mount.height_m + T[10] * origin_height_m;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i) {
    const double azimuth_rad = 2 * std::numbers::pi * i / kDirections;
    const auto [x, y, z] =
        apply(T, std::cos(elevation_rad) * std::cos(azimuth_rad),
              std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad));
    if (z < 0) nearest_m = std::min(nearest_m, start_m / -z * std::hypot(x, y));
  }
  return nearest_m;
}

/// Makes the ring of a beam that starts `origin_height_m` above the sensor's origin. `past_axis(d)`
/// converts the horizontal distance `d` from the beam's start to a distance from the axis of
/// rotation.
template <class PastAxis>
Ring ring_past_axis(double elevation_rad, double origin_height_m, const Mount& mount,
                    double range_limit_m, const PastAxis& past_axis) {
  const double seen_rad = is_upside_down(mount) ? -elevation_rad : elevation_rad;
  const double start_m = is_upside_down(mount) ? -origin_height_m : origin_height_m;
  const double level_m = (mount.height_m + start_m) / std::tan(-seen_rad);
  const double along_m =
      leans(mount) ? nearest_ground_m(elevation_rad, origin_height_m, mount) : level_m;
  const double distance_m = past_axis(along_m);
  const bool is_level_below = seen_rad < 0 && along_m > 0;
  const bool reaches = (leans(mount) || is_level_below) && distance_m <= range_limit_m;
  return {seen_rad, start_m, reaches ? distance_m : std::numeric_limits<double>::infinity()};
}

}  // namespace

Ring ring(double elevation_rad, double origin_height_m, const Mount& mount, double range_limit_m) {
  return ring_past_axis(elevation_rad, origin_height_m, mount, range_limit_m,
                        [](double along_m) { return along_m; });
}

RingProfile ring_profile(const hdl64e::Hdl64eCalibration& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_upward(rows_by_elevation(calibration), mount);
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
  const auto rows = rows_upward(rows_by_elevation(calibration), mount);
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

RingProfile ring_profile(const beams::BeamTable& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_upward(rows_by_elevation(calibration), mount);
  RingProfile profile{std::vector<Ring>(rows.size()), mount};
  for (std::size_t laser = 0; laser < rows.size(); ++laser) {
    profile.rings[static_cast<std::size_t>(rows[laser])] =
        ring(calibration.lasers[laser].elevation_rad, calibration.lasers[laser].vert_offset_m,
             mount, range_limit_m);
  }
  return profile;
}

RingProfile ring_profile(const ouster::OusterCalibration& calibration, const Mount& mount,
                         double range_limit_m) {
  const auto rows = rows_upward(rows_by_elevation(calibration), mount);
  RingProfile profile{std::vector<Ring>(rows.size()), mount};
  for (std::size_t laser = 0; laser < rows.size(); ++laser) {
    const beams::TableBeam& beam = calibration.lasers[laser];
    profile.rings[static_cast<std::size_t>(rows[laser])] = ring_past_axis(
        beam.elevation_rad, beam.vert_offset_m + calibration.T_sensor_lidar[11], mount,
        range_limit_m, [&](double along_m) {
          return std::hypot(along_m * std::cos(beam.azimuth_offset_rad) + calibration.ahead_m,
                            along_m * std::sin(beam.azimuth_offset_rad));
        });
  }
  return profile;
}

}  // namespace terracut::mount
