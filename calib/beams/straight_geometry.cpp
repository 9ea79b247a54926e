// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/beams/straight_geometry.hpp"

namespace terracut::beams {
namespace {

constexpr double dot(const Direction& a, const Direction& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

}  // namespace

Ray StraightGeometry::ray(int laser, double azimuth_rad) const noexcept {
  const Beam& beam = beams_[static_cast<std::size_t>(laser) % beams_.size()];
  const double pointed_rad = azimuth_rad + beam.offset_rad;
  return {{lens_ahead_m_ * std::cos(azimuth_rad), -lens_ahead_m_ * std::sin(azimuth_rad),
           beam.vert_offset_m},
          {beam.cos_elevation * std::cos(pointed_rad), -beam.cos_elevation * std::sin(pointed_rad),
           beam.sin_elevation}};
}

Point StraightGeometry::point(int laser, double azimuth_rad, double raw_counts) const noexcept {
  const Ray beam = ray(laser, azimuth_rad);
  const double along_m = raw_counts * metres_per_count_;
  return {beam.origin.x_m + along_m * beam.direction.x,
          beam.origin.y_m + along_m * beam.direction.y,
          beam.origin.z_m + along_m * beam.direction.z};
}

std::optional<double> StraightGeometry::raw_on_plane(int laser, double azimuth_rad,
                                                     const Point& hit,
                                                     const Direction& normal) const noexcept {
  // If the sine of the angle between beam and plane is below this, the result would be rounding
  // noise.
  constexpr double kParallel = 1e-12;
  const Ray beam = ray(laser, azimuth_rad);
  const double approach = dot(normal, beam.direction);
  if (std::abs(approach) <= kParallel * std::sqrt(dot(normal, normal))) return std::nullopt;
  const double along_m = dot(normal, {hit.x_m - beam.origin.x_m, hit.y_m - beam.origin.y_m,
                                      hit.z_m - beam.origin.z_m}) /
                         approach;
  const double raw = along_m / metres_per_count_;
  return raw >= 1.0 && raw <= kMaxRawCounts ? std::optional(raw) : std::nullopt;
}

}  // namespace terracut::beams
