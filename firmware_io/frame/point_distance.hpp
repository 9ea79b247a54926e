// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

#include "firmware_io/frame/point_planes.hpp"

namespace terracut::frame {

/// Returns the square of the distance between two cells' returns, metres squared; no comparison
/// with it is true if one of the cells has no return.
[[nodiscard]] inline float distance_squared_m2(const PointPlanes& points, std::size_t a,
                                               std::size_t b) noexcept {
  const float x_m = points.x_m[a] - points.x_m[b];
  const float y_m = points.y_m[a] - points.y_m[b];
  const float z_m = points.z_m[a] - points.z_m[b];
  return x_m * x_m + y_m * y_m + z_m * z_m;
}

}  // namespace terracut::frame
