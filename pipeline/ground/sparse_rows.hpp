// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"

namespace terracut::ground {

struct SegmenterConfig;

/// Parameters for sensors whose rows are far apart. A dense sensor sees a car's flank from the foot
/// upwards; a sparse sensor sees a single return somewhere on the flank, and the next return behind
/// it may be on the neighbour's wall.
struct SparseRows {
  float from_deg = 0.5F;              ///< Rows at least this far apart count as sparse, [0, 90].
  float step_up_limit_m = 0.23F;      ///< Replaces step_up_limit_m of GroundSurface::Config.
  float regain_gap_m = 3.0F;          ///< Replaces regain_gap_m of GroundSurface::Config.
  float min_lower_height_m = 0.015F;  ///< Replaces min_lower_height_m of AdjacentPoints::Config.
};

/// Returns the median gap between beams 10 to 2 degrees below the horizon, which meet level ground
/// some 10 to 50 m away, where a gap can hide objects. Infinite with fewer than two such beams.
[[nodiscard]] double row_gap_rad(const mount::RingProfile& profile);

/// Returns the configuration for a sensor's rows: `config` unchanged unless the rows are sparse.
[[nodiscard]] SegmenterConfig suited_to_rows(const SegmenterConfig& config,
                                             const mount::RingProfile& profile);

}  // namespace terracut::ground
