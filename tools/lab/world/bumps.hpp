// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "value_noise.hpp"

namespace terracut::world {

inline constexpr double kLongBump_m = 5.0;  ///< Wave lengths of the two layers of bumps.
inline constexpr double kShortBump_m = 1.3;
inline constexpr double kShortBumpShare = 0.25;

/// Returns the height of ground of roughness 1, in about [-1, 1]: the sum of long bumps and shorter
/// ones.
[[nodiscard]] inline double bumps(std::uint64_t seed, double x_m, double y_m) noexcept {
  return (1 - kShortBumpShare) * value_noise(seed, x_m / kLongBump_m, y_m / kLongBump_m) +
         kShortBumpShare * value_noise(~seed, x_m / kShortBump_m, y_m / kShortBump_m);
}

/// Returns an upper bound of the slope of bumps of height `bumps_m`. It is rarely reached, as that
/// takes neighbouring extremes in both layers at once.
[[nodiscard]] constexpr double steepest_of_bumps(double bumps_m) noexcept {
  return bumps_m * 3.0 * ((1 - kShortBumpShare) / kLongBump_m + kShortBumpShare / kShortBump_m);
}

}  // namespace terracut::world
