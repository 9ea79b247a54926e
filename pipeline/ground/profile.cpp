// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/profile.hpp"

namespace terracut::ground {

SegmenterConfig terracut_profile() noexcept {
  return {};
}

SegmenterConfig paper_profile() noexcept {
  SegmenterConfig config;
  config.elevation_map.grid.min_band_m = 0;
  config.elevation_map.grid.max_band_m = 1e9F;  // never split
  config.elevation_map.reference = elevation::GroundReference::kCellMinimum;
  config.elevation_map.obstacle_height_m = 0.20F;

  config.adjacent_points.rule = elevation::AdjacentRule::kRingSpacing;
  config.adjacent_points.max_slope_rad = 0.50F;
  config.adjacent_points.first_row_step = 2;
  config.adjacent_points.last_row_step = 2;
  config.adjacent_points.row_step_deg = 0;
  config.adjacent_points.column_reach = 3;

  config.seeds.ground_share = 0.8F;
  config.seeds.rows = random_field::CutRows::kAll;

  config.region.rule = random_field::RegionRule::kHistogram;
  config.region.lambda = 1.0F;
  config.boundary.rule = random_field::BoundaryRule::kHeightGradient;
  return config;
}

}  // namespace terracut::ground
