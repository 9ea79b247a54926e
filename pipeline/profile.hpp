// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "pipeline/adjacent_points.hpp"
#include "pipeline/boundary_term.hpp"
#include "pipeline/confidence_seeds.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/grid_cut.hpp"
#include "pipeline/region_term.hpp"
#include "pipeline/return_labels.hpp"
#include "pipeline/ring_elevation_map.hpp"
#include "pipeline/road_surface.hpp"
#include "pipeline/stage.hpp"

namespace terracut::pipeline {

/// Every parameter of the method, by stage. The defaults are the `terracut` profile.
struct SegmenterConfig {
  /// kElevationMap, kAdjacentPoints or kMinCut: the rows of the paper's Table III.
  Stage last_stage = Stage::kMinCut;
  RingElevationMap::Config elevation_map = terracut_elevation_map();
  AdjacentPoints::Config adjacent_points;
  ConfidenceSeeds::Config seeds;
  RegionTerm::Config region;
  BoundaryTerm::Config boundary;
  GridCut::Config min_cut;
  ReturnLabels::Config returns;
  RoadSurface::Config road;

  [[nodiscard]] static RingElevationMap::Config terracut_elevation_map() noexcept;
};

/// The default: whatever was measured better, on the paper's skeleton (docs/method.md).
[[nodiscard]] SegmenterConfig terracut_profile() noexcept;

/// The method as printed; what the paper leaves open is set as docs/method.md says.
[[nodiscard]] SegmenterConfig paper_profile() noexcept;

}  // namespace terracut::pipeline
