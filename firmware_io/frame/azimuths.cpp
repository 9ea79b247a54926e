// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/azimuths.hpp"

#include <cmath>
#include <numbers>

#include "rt/vector_clones.hpp"

namespace terracut::frame {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTanOfSixteenth = 0.41421356F;  // tan(pi / 8), a sixteenth of a revolution

/// Returns atan(t) by its series for |t| <= kTanOfSixteenth, where the first term left out is
/// 1.2e-7.
[[gnu::always_inline]] inline float short_atan(float t) noexcept {
  const float u = t * t;
  float sum = 1.0F / 13;
  sum = 1.0F / 11 - u * sum;
  sum = 1.0F / 9 - u * sum;
  sum = 1.0F / 7 - u * sum;
  sum = 1.0F / 5 - u * sum;
  sum = 1.0F / 3 - u * sum;
  return t - t * u * sum;
}

/// Folds each direction onto the first eighth of a revolution, then onto the lower half of that
/// eighth. The loop has no branches, so that the compiler vectorises it: each condition selects
/// between two values that are already computed.
TERRACUT_VECTOR_CLONES void find_all(const CloudPoint* __restrict points, std::size_t count,
                                     float* __restrict azimuths_rad) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float x = points[i].x_m, y = points[i].y_m;
    const float along = std::fabs(x), aside = std::fabs(y);
    const bool is_beyond = along < aside, is_behind = x < 0, is_left = y > 0;
    const float smaller = is_beyond ? along : aside, larger = is_beyond ? aside : along;
    const bool is_steep = smaller > kTanOfSixteenth * larger;
    const float rise = smaller - (is_steep ? larger : 0.0F);
    const float run = larger + (is_steep ? smaller : 0.0F);
    const float eighth = short_atan(rise / (run > 0 ? run : 1.0F)) + (is_steep ? kPi / 4 : 0.0F);
    const float quarter = (is_beyond ? kPi / 2 : 0.0F) + (is_beyond ? -1.0F : 1.0F) * eighth;
    const float half = (is_behind ? kPi : 0.0F) + (is_behind ? -1.0F : 1.0F) * quarter;
    const float clockwise = (is_left ? 2 * kPi : 0.0F) + (is_left ? -1.0F : 1.0F) * half;
    azimuths_rad[i] = clockwise < 2 * kPi ? clockwise : 0.0F;
  }
}

}  // namespace

void find_azimuths(std::span<const CloudPoint> points, std::span<float> azimuths_rad) noexcept {
  find_all(points.data(), points.size(), azimuths_rad.data());
}

}  // namespace terracut::frame
