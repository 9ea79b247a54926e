// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/sparse_rows.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "calib/beams/angle.hpp"
#include "pipeline/ground/profile.hpp"

namespace terracut::ground {

double row_gap_rad(const mount::RingProfile& profile) {
  const auto counts = [](const mount::Ring& ring) {
    const double deg = beams::rad_to_deg(ring.elevation_rad);
    return deg >= -10 && deg <= -2;
  };
  std::vector<double> gaps_rad;
  for (std::size_t row = 1; row < profile.rings.size(); ++row) {
    const mount::Ring &lower = profile.rings[row - 1], &upper = profile.rings[row];
    if (counts(lower) && counts(upper)) {
      gaps_rad.push_back(upper.elevation_rad - lower.elevation_rad);
    }
  }
  if (gaps_rad.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = gaps_rad.begin() + static_cast<std::ptrdiff_t>(gaps_rad.size() / 2);
  std::ranges::nth_element(gaps_rad, middle);
  return *middle;
}

SegmenterConfig suited_to_rows(const SegmenterConfig& config, const mount::RingProfile& profile) {
  const SparseRows& sparse = config.sparse;
  if (row_gap_rad(profile) < beams::deg_to_rad(double{sparse.from_deg})) return config;
  SegmenterConfig suited = config;
  suited.elevation_map.surface.step_up_limit_m = sparse.step_up_limit_m;
  suited.elevation_map.surface.regain_gap_m = sparse.regain_gap_m;
  suited.adjacent_points.min_lower_height_m = sparse.min_lower_height_m;
  return suited;
}

}  // namespace terracut::ground
