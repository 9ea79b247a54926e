// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_geometry.hpp"

#include <cmath>

namespace terracut::ruby128 {
namespace {

/// Below this sine of the angle between beam and plane the beam runs along it: what is left is
/// rounding.
constexpr double kParallel = 1e-12;

double dot(const beams::Direction& a, const beams::Direction& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// False for NaN, so that what no beam reaches ends as nothing.
std::optional<double> raw_at(double along_m) noexcept {
  const double raw = along_m / kRuby128MetresPerCount;
  return raw >= 1.0 && raw <= beams::kMaxRawCounts ? std::optional(raw) : std::nullopt;
}

}  // namespace

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
  const beams::Ray r = ray(channel, azimuth_rad);
  const double along_m = raw_counts * kRuby128MetresPerCount;
  return {r.origin.x_m + along_m * r.direction.x, r.origin.y_m + along_m * r.direction.y,
          r.origin.z_m + along_m * r.direction.z};
}

std::optional<double> Ruby128Geometry::raw_for_range(int channel, double /*azimuth_rad*/,
                                                     double range_m) const noexcept {
  // range^2 = d^2 + 2 d R cos v cos h + R^2, whatever the head's azimuth.
  const Beam& b = beam(channel);
  const double half_slope_m = kRuby128LensAhead_m * b.cos_elevation * std::cos(b.offset_rad);
  const double beyond_lens_m2 = range_m * range_m - kRuby128LensAhead_m * kRuby128LensAhead_m;
  return raw_at(std::sqrt(half_slope_m * half_slope_m + beyond_lens_m2) - half_slope_m);
}

std::optional<double> Ruby128Geometry::raw_on_plane(int channel, double azimuth_rad,
                                                    const beams::Point& hit,
                                                    const beams::Direction& normal) const noexcept {
  const beams::Ray r = ray(channel, azimuth_rad);
  const double approach = dot(normal, r.direction);
  if (std::abs(approach) <= kParallel * std::sqrt(dot(normal, normal))) return std::nullopt;
  const beams::Direction to_hit{hit.x_m - r.origin.x_m, hit.y_m - r.origin.y_m,
                                hit.z_m - r.origin.z_m};
  return raw_at(dot(normal, to_hit) / approach);
}

}  // namespace terracut::ruby128
