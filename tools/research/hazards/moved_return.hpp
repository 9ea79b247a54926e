// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

namespace terracut::hazards {

/// What a hazard or a disturbance makes of one return of a frame.
struct MovedReturn {
  std::uint32_t index = 0;  ///< Return index.
  double range_m = 0;       ///< Its new distance from the sensor, along its beam; 0: it is gone.
  bool counts = false;      ///< True if it shows the hazard and should be called obstacle.
};

/// In order of return index, each at most once.
using MovedReturns = std::vector<MovedReturn>;

}  // namespace terracut::hazards
