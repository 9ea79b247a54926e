// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "outline.hpp"

#include <cmath>
#include <numbers>
#include <ranges>

namespace terracut::free_way {

std::vector<Corner> outline(std::span<const Sector> sectors) {
  std::vector<Corner> corners;
  corners.reserve(2 * sectors.size());
  const float half_rad = std::numbers::pi_v<float> / static_cast<float>(sectors.size());
  for (const Sector& sector : std::views::reverse(sectors)) {
    for (const float edge_rad : {sector.azimuth_rad - half_rad, sector.azimuth_rad + half_rad}) {
      corners.push_back(
          {sector.free_m() * std::cos(edge_rad), sector.free_m() * std::sin(edge_rad)});
    }
  }
  return corners;
}

float clockwise_turns(Corner place) noexcept {
  constexpr float kTurn_rad = 2 * std::numbers::pi_v<float>;
  const float clockwise_rad = std::atan2(-place.y_m, place.x_m);
  return (clockwise_rad < 0 ? clockwise_rad + kTurn_rad : clockwise_rad) / kTurn_rad;
}

}  // namespace terracut::free_way
