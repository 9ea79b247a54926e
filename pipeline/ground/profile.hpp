// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "pipeline/elevation/adjacent_points.hpp"
#include "pipeline/elevation/ring_elevation_map.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/grid_cut.hpp"
#include "pipeline/random_field/boundary_term.hpp"
#include "pipeline/random_field/confidence_seeds.hpp"
#include "pipeline/random_field/region_term.hpp"
#include "pipeline/road/road_surface.hpp"
#include "pipeline/stage/return_labels.hpp"
#include "pipeline/stage/stage.hpp"

namespace terracut::ground {

/// Every parameter of the method, by stage. The defaults are those of the profile `terracut`.
struct SegmenterConfig {
  /// The last stage to run: kElevationMap, kAdjacentPoints or kMinCut (paper, Table III).
  stage::Stage last_stage = stage::Stage::kMinCut;
  elevation::RingElevationMap::Config elevation_map;
  elevation::AdjacentPoints::Config adjacent_points;
  random_field::ConfidenceSeeds::Config seeds;
  random_field::RegionTerm::Config region;
  random_field::BoundaryTerm::Config boundary;
  min_cut::GridCut::Config min_cut;
  stage::ReturnLabels::Config returns;
  road::RoadSurface::Config road;
  /// Also gives the height above the ground of every return. No parameter: labels do not change.
  bool gives_heights = false;

  /// Returns the height above the ground below which returns are counted as ghosts
  /// (stage::SegmentationReport::below), metres.
  [[nodiscard]] float ghost_limit_m() const noexcept {
    return -2 * elevation_map.obstacle_height_m;
  }
};

/// Returns the default profile: the paper's structure with measured improvements
/// (docs/reference/method.md).
[[nodiscard]] SegmenterConfig terracut_profile() noexcept;

/// Returns the method as published; decision 36 lists what the paper leaves open.
[[nodiscard]] SegmenterConfig paper_profile() noexcept;

}  // namespace terracut::ground
