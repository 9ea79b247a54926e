// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>

#include "tools/lab/world/random.hpp"

namespace terracut::world {

/// Returns smooth random heights over the plane in [-1, 1]: random values on a grid of 1 x 1,
/// interpolated by the cubic smoothstep. Slope per axis at most 3.
[[nodiscard]] inline double value_noise(std::uint64_t seed, double x, double y) noexcept {
  const double column = std::floor(x);
  const double row = std::floor(y);
  const auto at = [&](double dx, double dy) {
    const auto i = static_cast<std::int64_t>(column + dx);
    const auto j = static_cast<std::int64_t>(row + dy);
    const std::uint64_t cell =
        static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U ^ static_cast<std::uint64_t>(j) << 32;
    return 2.0 * world::unit_interval(world::scramble(seed ^ cell)) - 1.0;
  };
  const double u = x - column;
  const double v = y - row;
  const double s = u * u * (3.0 - 2.0 * u);
  const double t = v * v * (3.0 - 2.0 * v);
  const double low = at(0, 0) + s * (at(1, 0) - at(0, 0));
  const double high = at(0, 1) + s * (at(1, 1) - at(0, 1));
  return low + t * (high - low);
}

}  // namespace terracut::world
