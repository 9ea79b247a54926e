// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/velodyne/velodyne_geometry.hpp"

#include <cmath>
#include <cstddef>

#include "calib/beams/straight_beam.hpp"

namespace terracut::velodyne {

VelodyneGeometry::VelodyneGeometry(const VelodyneCalibration& calibration, double metres_per_count)
    : metres_per_count_(metres_per_count) {
  for (const VelodyneLaser& laser : calibration.lasers) {
    beams_.push_back({laser.azimuth_offset_rad, std::cos(laser.elevation_rad),
                      std::sin(laser.elevation_rad), laser.vert_offset_m});
  }
}

beams::Ray VelodyneGeometry::ray(int channel, double azimuth_rad) const noexcept {
  const Beam& beam = beams_[static_cast<std::size_t>(channel) % beams_.size()];
  const double pointed_rad = azimuth_rad + beam.offset_rad;
  return {{0, 0, beam.vert_offset_m},
          {beam.cos_elevation * std::cos(pointed_rad), -beam.cos_elevation * std::sin(pointed_rad),
           beam.sin_elevation}};
}

beams::Point VelodyneGeometry::point(int channel, double azimuth_rad,
                                     double raw_counts) const noexcept {
  return beams::point_along(ray(channel, azimuth_rad), raw_counts * metres_per_count_);
}

std::optional<double> VelodyneGeometry::raw_for_range(int channel, double azimuth_rad,
                                                      double range_m) const noexcept {
  return beams::counts_of(beams::along_at_range(ray(channel, azimuth_rad), range_m),
                          metres_per_count_);
}

std::optional<double> VelodyneGeometry::raw_on_plane(
    int channel, double azimuth_rad, const beams::Point& hit,
    const beams::Direction& normal) const noexcept {
  return beams::counts_of(beams::along_at_plane(ray(channel, azimuth_rad), hit, normal),
                          metres_per_count_);
}

}  // namespace terracut::velodyne
