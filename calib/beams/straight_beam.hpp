// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "calib/beams/beam.hpp"

/// The arithmetic shared by all sensors whose returns lie on straight beams. Any thread.
namespace terracut::beams {

[[nodiscard]] constexpr double dot(const Direction& a, const Direction& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

[[nodiscard]] constexpr Point point_along(const Ray& ray, double along_m) noexcept {
  return {ray.origin.x_m + along_m * ray.direction.x, ray.origin.y_m + along_m * ray.direction.y,
          ray.origin.z_m + along_m * ray.direction.z};
}

/// Returns how far along the beam it is `range_m` from the sensor's origin; NaN if it never is.
[[nodiscard]] inline double along_at_range(const Ray& ray, double range_m) noexcept {
  const Direction start{ray.origin.x_m, ray.origin.y_m, ray.origin.z_m};
  const double nearest_m = -dot(start, ray.direction);
  return nearest_m + std::sqrt(nearest_m * nearest_m + range_m * range_m - dot(start, start));
}

/// Returns how far along the beam it meets the plane through `hit` with `normal` (any length); NaN
/// if it runs parallel to the plane.
[[nodiscard]] inline double along_at_plane(const Ray& ray, const Point& hit,
                                           const Direction& normal) noexcept {
  // The sine of the angle between beam and plane is rounding error below this.
  constexpr double kParallel = 1e-12;
  const double approach = dot(normal, ray.direction);
  if (std::abs(approach) <= kParallel * std::sqrt(dot(normal, normal))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return dot(normal,
             {hit.x_m - ray.origin.x_m, hit.y_m - ray.origin.y_m, hit.z_m - ray.origin.z_m}) /
         approach;
}

/// Returns the wire's distance, not rounded; nothing if it is NaN or outside [1, 65535].
[[nodiscard]] inline std::optional<double> counts_of(double along_m,
                                                     double metres_per_count) noexcept {
  const double raw = along_m / metres_per_count;
  return raw >= 1.0 && raw <= kMaxRawCounts ? std::optional(raw) : std::nullopt;
}

}  // namespace terracut::beams
