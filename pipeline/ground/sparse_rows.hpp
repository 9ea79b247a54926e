// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"

namespace terracut::ground {

struct SegmenterConfig;

/// Parameters for sensors whose rows are far apart. A dense sensor sees a car's flank from the foot
/// upwards; a sparse one sees a single return somewhere on it, and the next return behind may be
/// the neighbour's wall.
struct SparseRows {
  float from_deg = 0.5F;              ///< Rows this far apart count as sparse, [0, 90].
  float step_up_limit_m = 0.23F;      ///< As in GroundSurface::Config.
  float regain_gap_m = 3.0F;          ///< As in GroundSurface::Config.
  float min_lower_height_m = 0.015F;  ///< As in AdjacentPoints::Config.
};

/// Returns the median gap between beams 10 to 2 degrees below the horizon, which meet level ground
/// some 10 to 50 m away, where a gap can hide objects. Infinite if there are none to compare.
[[nodiscard]] double row_gap_rad(const mount::RingProfile& profile);

/// Returns the configuration for a sensor's rows: `config` itself, unless they are sparse.
[[nodiscard]] SegmenterConfig suited_to_rows(const SegmenterConfig& config,
                                             const mount::RingProfile& profile);

}  // namespace terracut::ground
