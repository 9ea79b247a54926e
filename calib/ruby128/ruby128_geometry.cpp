// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_geometry.hpp"

#include <cmath>

#include "calib/beams/straight_beam.hpp"

namespace terracut::ruby128 {
Ruby128Geometry::Ruby128Geometry(const Ruby128Calibration& calibration) noexcept {
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const Ruby128Channel& channel = calibration.channels[i];
    beams_[i] = {channel.azimuth_offset_rad, std::cos(channel.elevation_rad),
                 std::sin(channel.elevation_rad)};
  }
}

beams::Ray Ruby128Geometry::ray(int channel, double azimuth_rad) const noexcept {
  const Beam& b = beam(channel);
  const double pointed_rad = azimuth_rad + b.offset_rad;
  return {{kRuby128LensAhead_m * std::cos(azimuth_rad),
           -kRuby128LensAhead_m * std::sin(azimuth_rad), 0.0},
          {b.cos_elevation * std::cos(pointed_rad), -b.cos_elevation * std::sin(pointed_rad),
           b.sin_elevation}};
}

beams::Point Ruby128Geometry::point(int channel, double azimuth_rad,
                                    double raw_counts) const noexcept {
  return beams::point_along(ray(channel, azimuth_rad), raw_counts * kRuby128MetresPerCount);
}

std::optional<double> Ruby128Geometry::raw_for_range(int channel, double azimuth_rad,
                                                     double range_m) const noexcept {
  return beams::counts_of(beams::along_at_range(ray(channel, azimuth_rad), range_m),
                          kRuby128MetresPerCount);
}

std::optional<double> Ruby128Geometry::raw_on_plane(int channel, double azimuth_rad,
                                                    const beams::Point& hit,
                                                    const beams::Direction& normal) const noexcept {
  return beams::counts_of(beams::along_at_plane(ray(channel, azimuth_rad), hit, normal),
                          kRuby128MetresPerCount);
}

}  // namespace terracut::ruby128
