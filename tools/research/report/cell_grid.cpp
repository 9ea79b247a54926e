// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cell_grid.hpp"

#include <cmath>
#include <numbers>

namespace terracut::report {

SquareGrid::SquareGrid(float side_m, float extent_m)
    : side_m_(side_m),
      extent_m_(extent_m),
      squares_(static_cast<std::size_t>(std::ceil(2 * extent_m / side_m))) {
  const auto middle_m = [&](std::size_t i) {
    return (static_cast<float>(i) + 0.5F) * side_m_ - extent_m_;
  };
  for (std::size_t row = 0; row < squares_; ++row) {
    for (std::size_t column = 0; column < squares_; ++column) {
      centre_range_m_.push_back(std::hypot(middle_m(row), middle_m(column)));
    }
  }
}

std::optional<std::size_t> SquareGrid::cell_of(const GroundPlace& place) const {
  const float x = (place.x_m + extent_m_) / side_m_, y = (place.y_m + extent_m_) / side_m_;
  const auto end = static_cast<float>(squares_);
  if (!(x >= 0 && x < end && y >= 0 && y < end)) return {};
  return static_cast<std::size_t>(x) * squares_ + static_cast<std::size_t>(y);
}

RingCells::RingCells(const elevation::RingGrid::Config& config, const mount::RingProfile& profile,
                     frame::ImageShape shape)
    : grid_(config, profile, shape, memory_) {
  for (int sector = 0; sector < grid_.sectors(); ++sector) {
    for (int band = 0; band < grid_.bands(); ++band) {
      centre_range_m_.push_back(grid_.center_m(band));
    }
  }
}

std::optional<std::size_t> RingCells::cell_of(const GroundPlace& place) const {
  return grid_.cell(grid_.sector_of(place.column), grid_.band_of(place.ground_range_m));
}

std::vector<GroundPlace> flat_world(const mount::RingProfile& profile, frame::ImageShape shape) {
  std::vector<GroundPlace> places;
  for (const mount::Ring& ring : profile.rings) {
    if (!std::isfinite(ring.ground_distance_m)) continue;
    for (int column = 0; column < shape.columns; ++column) {
      const double azimuth = 2 * std::numbers::pi * (column + 0.5) / shape.columns;
      places.push_back({static_cast<float>(ring.ground_distance_m * std::cos(azimuth)),
                        static_cast<float>(-ring.ground_distance_m * std::sin(azimuth)),
                        static_cast<float>(ring.ground_distance_m), column});
    }
  }
  return places;
}

}  // namespace terracut::report
