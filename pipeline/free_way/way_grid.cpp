// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "way_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "outline.hpp"

namespace terracut::free_way {
namespace {

/// Where a cell's middle lies.
struct Place {
  float turns, away_m;  ///< clockwise_turns(), and its distance.
};

/// Returns the places of all cells, computed once.
const std::vector<Place>& places() {
  static const std::vector<Place> all = [] {
    const auto middle_m = [](std::size_t cell) {
      return WayGrid::kFirst_m + WayGrid::kCell_m * (static_cast<float>(cell) + 0.5F);
    };
    std::vector<Place> of_cells;
    for (std::size_t cell = 0; cell < WayGrid::kSide * WayGrid::kSide; ++cell) {
      const Corner at{middle_m(cell % WayGrid::kSide), middle_m(cell / WayGrid::kSide)};
      of_cells.push_back({clockwise_turns(at), std::hypot(at.x_m, at.y_m)});
    }
    return of_cells;
  }();
  return all;
}

}  // namespace

void WayGrid::fill(std::span<const Sector> sectors) {
  std::ranges::fill(cells, Cell::kUnknown);
  if (sectors.empty()) return;
  const std::vector<Place>& of_cells = places();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_free = of_cells[i].away_m < sector_towards(of_cells[i].turns, sectors).free_m();
    if (is_free) cells[i] = Cell::kFree;
  }
  constexpr float kFarthest_m = -kFirst_m * std::numbers::sqrt2_v<float>;
  const float half_rad = std::numbers::pi_v<float> / static_cast<float>(sectors.size());
  for (const Sector& sector : sectors) {
    const float stop_m = sector.stop_m();
    if (!(stop_m < kFarthest_m)) continue;
    const int steps = 1 + static_cast<int>(4 * half_rad * stop_m / kCell_m);  // half a cell each
    for (int step = 0; step <= steps; ++step) {
      const float beside = 2 * static_cast<float>(step) / static_cast<float>(steps) - 1;
      const float azimuth_rad = sector.azimuth_rad + beside * half_rad;
      const float x = (stop_m * std::cos(azimuth_rad) - kFirst_m) / kCell_m;
      const float y = (stop_m * std::sin(azimuth_rad) - kFirst_m) / kCell_m;
      constexpr auto kEnd = static_cast<float>(kSide);
      if (x < 0 || y < 0 || x >= kEnd || y >= kEnd) continue;
      cells[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] = Cell::kOccupied;
    }
  }
}

}  // namespace terracut::free_way
