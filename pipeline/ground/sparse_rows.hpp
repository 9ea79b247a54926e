// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"

namespace terracut::ground {

struct SegmenterConfig;

/// What holds instead where rows are far apart. What a dense sensor sees of a car's flank from the
/// foot upwards, a sparse one sees a single return of, anywhere on it; and its next return behind
/// may be the neighbour's wall.
struct SparseRows {
  float from_deg = 0.5F;              ///< Rows this far apart are sparse, [0, 90].
  float step_up_limit_m = 0.23F;      ///< GroundSurface::Config
  float regain_gap_m = 3.0F;          ///< GroundSurface::Config
  float min_lower_height_m = 0.015F;  ///< AdjacentPoints::Config
};

/// How far apart the rows are that meet level ground some 10 to 50 m away, where things stand that
/// a gap between rows can hide: the median, of beams 10 to 2 degrees below the horizon. Infinite
/// where there are none to compare.
[[nodiscard]] double row_gap_rad(const mount::RingProfile& profile);

/// The configuration that suits a sensor's rows: `config` itself, unless they are sparse.
[[nodiscard]] SegmenterConfig suited_to_rows(const SegmenterConfig& config,
                                             const mount::RingProfile& profile);

}  // namespace terracut::ground
