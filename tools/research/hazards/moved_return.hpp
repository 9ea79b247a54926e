// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

namespace terracut::hazards {

/// A return that a hazard or a disturbance has moved or removed.
struct MovedReturn {
  std::uint32_t index = 0;  ///< Return index.
  double range_m = 0;       ///< New distance from the sensor along the beam; 0: removed.
  bool counts = false;      ///< True if it belongs to the hazard and should be an obstacle.
};

/// Moved returns in order of return index, each at most once.
using MovedReturns = std::vector<MovedReturn>;

}  // namespace terracut::hazards
