// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terracut::objects {
namespace {

using stage::FourFloats;

// Cosines of 0, 22.5, 45 and 67.5 degrees.
constexpr float k0 = 1.0F, k22 = 0.92387953F, k45 = 0.70710678F, k67 = 0.38268343F;
constexpr std::array<FourFloats, 2> kAxesX{FourFloats{k0, k22, k45, k67},
                                           FourFloats{0, -k67, -k45, -k22}};
constexpr std::array<FourFloats, 2> kAxesY{FourFloats{0, k67, k45, k22},
                                           FourFloats{k0, k22, k45, k67}};

// The same without signs.
constexpr std::array<FourFloats, 2> kWidthsX{FourFloats{k0, k22, k45, k67},
                                             FourFloats{0, k67, k45, k22}};
constexpr std::array<FourFloats, 2> kWidthsY = kAxesY;

}  // namespace

void Outermost::begin(const frame::PointPlanes& points, std::uint32_t cell) noexcept {
  for (std::size_t half = 0; half < kHalves; ++half) {
    most_[half] = least_[half] = points.x_m[cell] * kAxesX[half] + points.y_m[cell] * kAxesY[half];
  }
  most_at_.fill(cell);
  least_at_.fill(cell);
}

void Outermost::add(const frame::PointPlanes& points, std::uint32_t cell) noexcept {
  for (std::size_t half = 0; half < kHalves; ++half) {
    const FourFloats way = points.x_m[cell] * kAxesX[half] + points.y_m[cell] * kAxesY[half];
    if (!stage::is_any((way > most_[half]) | (way < least_[half]))) [[likely]]
      continue;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if (way[lane] > most_[half][lane]) {
        most_[half][lane] = way[lane];
        most_at_[4 * half + lane] = cell;
      }
      if (way[lane] < least_[half][lane]) {
        least_[half][lane] = way[lane];
        least_at_[4 * half + lane] = cell;
      }
    }
  }
}

bool Outermost::exceed(const Extent& extent) const noexcept {
  const FourFloats middle_m = (extent.least_m + extent.most_m) * 0.5F;
  const FourFloats half_m = extent.most_m - middle_m;
  stage::FourInts outside{};
  for (std::size_t half = 0; half < kHalves; ++half) {
    const FourFloats way = middle_m[0] * kAxesX[half] + middle_m[1] * kAxesY[half];
    const FourFloats aside = half_m[0] * kWidthsX[half] + half_m[1] * kWidthsY[half];
    outside |= (way + aside > most_[half]) | (way - aside < least_[half]);
  }
  return stage::is_any(outside);
}

void Outermost::add(const frame::PointPlanes& points, const Run& run,
                    const Extent& extent) noexcept {
  if (!exceed(extent)) return;
  for (std::uint32_t cell = run.begin; cell < run.end; ++cell) add(points, cell);
}

Footprint Outermost::footprint(const frame::PointPlanes& points) const noexcept {
  Footprint footprint;
  std::uint32_t first = 0, last = 0;
  const auto take = [&](std::uint32_t cell) {
    if (footprint.count > 0 && (cell == last || cell == first)) return;
    if (footprint.count == 0) first = cell;
    last = cell;
    footprint.corners[footprint.count++] = {points.x_m[cell], points.y_m[cell]};
  };
  for (const std::uint32_t cell : most_at_) take(cell);
  for (const std::uint32_t cell : least_at_) take(cell);
  return footprint;
}

Box box_around(const Footprint& footprint) noexcept {
  Box best;
  best.middle = footprint.corners[0];
  float least_m2 = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < footprint.count; ++i) {
    const Corner& from = footprint.corners[i];
    const Corner& to = footprint.corners[(i + 1) % footprint.count];
    const float x_m = to.x_m - from.x_m, y_m = to.y_m - from.y_m;
    const float side_m = std::sqrt(x_m * x_m + y_m * y_m);
    if (!(side_m > 0)) continue;
    const Corner along{x_m / side_m, y_m / side_m};
    float begin_m = 0, end_m = 0, right_m = 0, left_m = 0;
    for (const Corner& corner : footprint.span()) {
      const float by_x_m = corner.x_m - from.x_m, by_y_m = corner.y_m - from.y_m;
      const float ahead_m = by_x_m * along.x_m + by_y_m * along.y_m;
      const float aside_m = by_y_m * along.x_m - by_x_m * along.y_m;
      begin_m = std::min(begin_m, ahead_m);
      end_m = std::max(end_m, ahead_m);
      right_m = std::min(right_m, aside_m);
      left_m = std::max(left_m, aside_m);
    }
    const float length_m = end_m - begin_m, width_m = left_m - right_m;
    if (length_m * width_m >= least_m2) continue;
    least_m2 = length_m * width_m;
    const float ahead_m = (begin_m + end_m) / 2, aside_m = (left_m + right_m) / 2;
    best = {.middle = {from.x_m + ahead_m * along.x_m - aside_m * along.y_m,
                       from.y_m + ahead_m * along.y_m + aside_m * along.x_m},
            .along = along,
            .length_m = length_m,
            .width_m = width_m};
    if (best.length_m < best.width_m) {
      std::swap(best.length_m, best.width_m);
      best.along = {-along.y_m, along.x_m};
    }
  }
  return best;
}

}  // namespace terracut::objects
