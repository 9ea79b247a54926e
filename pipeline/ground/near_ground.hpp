// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The returns from which the mount is found: those in a strip before and behind the vehicle, on
/// the surface it stands on. Beside the strip a crowned road falls away. Farther ground is not one
/// plane where a slope begins: on the simulated hill, the estimated height of a sensor 3 m up is
/// 0.7 m too large from ground up to 25 m away, and 0.1 m too small from ground up to 15 m away.
struct NearGround {
  static constexpr float kHalfWidth_m = 1.5F;
  static constexpr float kNearest_m = 3.0F;  ///< Nearer returns may be the vehicle itself.
  static constexpr float kFarthest_m = 15.0F;
  static constexpr std::size_t kMost = 8192;
  static constexpr std::size_t kMostCellsLookedAt = 4 * kMost;

  std::size_t count = 0;
  std::array<std::array<float, 3>, kMost> points;  ///< x, y, z in the vehicle frame, metres.

  [[nodiscard]] std::span<const std::array<float, 3>> in_use() const noexcept {
    return std::span(points).first(count);
  }
};

/// True if a position (metres, vehicle frame) lies in the strip of near ground, up to `farthest_m`.
[[nodiscard]] constexpr bool is_near_ground_place(
    float x_m, float y_m, float farthest_m = NearGround::kFarthest_m) noexcept {
  const float range2_m2 = x_m * x_m + y_m * y_m;
  return y_m <= NearGround::kHalfWidth_m && y_m >= -NearGround::kHalfWidth_m &&
         range2_m2 >= NearGround::kNearest_m * NearGround::kNearest_m &&
         range2_m2 <= farthest_m * farthest_m;
}

/// Adds the returns of the strip up to `farthest_m` in these columns to `ground`, evenly thinned:
/// of a whole turn at most kMostCellsLookedAt cells are looked at. Real-time safe.
void add_near_ground(const frame::PointPlanes& points, frame::ColumnRange columns,
                     const frame::ImageShape& shape, NearGround& ground,
                     float farthest_m = NearGround::kFarthest_m) noexcept TERRACUT_NONBLOCKING;
/// Fills `ground` with near ground from an image.
inline void take_near_ground(const frame::RangeImage& image, NearGround& ground,
                             float farthest_m = NearGround::kFarthest_m) noexcept
    TERRACUT_NONBLOCKING {
  ground.count = 0;
  add_near_ground(image.points(), {0, image.shape().columns}, image.shape(), ground, farthest_m);
}

/// Fills `ground` with returns of the whole image, near and far, evenly thinned.
void take_around(const frame::RangeImage& image, NearGround& ground) noexcept;

}  // namespace terracut::ground
