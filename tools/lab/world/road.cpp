// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "road.hpp"

#include <cmath>
#include <numbers>

namespace terracut::world {

double Road::centre_y_m(double s_m) const noexcept {
  if (bend_m == 0) return 0;
  return bend_m * (1.0 - std::cos(2.0 * std::numbers::pi * s_m / bend_length_m));
}

double Road::centre_slope(double s_m) const noexcept {
  if (bend_m == 0) return 0;
  const double wave = 2.0 * std::numbers::pi / bend_length_m;
  return bend_m * wave * std::sin(wave * s_m);
}

double Road::heading_rad(double s_m) const noexcept {
  return std::atan(centre_slope(s_m));
}

// Measures the distance from the centre line at the same x. This is exact on straight roads and on
// the centre line, and close enough in gentle bends; y_m() inverts it exactly.
Road::Location Road::locate(double x_m, double y_m) const noexcept {
  if (bend_m == 0) return {{x_m, y_m}, 0};
  const double wave = 2.0 * std::numbers::pi / bend_length_m;
  const double slope = bend_m * wave * std::sin(wave * x_m);
  const double centre_m = bend_m * (1.0 - std::cos(wave * x_m));
  return {{x_m, (y_m - centre_m) / std::sqrt(1.0 + slope * slope)}, slope};
}

double Road::y_m(const RoadPoint& place) const noexcept {
  const double slope = centre_slope(place.s_m);
  return centre_y_m(place.s_m) + place.d_m * std::sqrt(1.0 + slope * slope);
}

}  // namespace terracut::world
