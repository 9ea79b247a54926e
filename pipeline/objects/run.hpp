// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/stage/float_lanes.hpp"

namespace terracut::objects {

/// Returns the lesser number, lane by lane.
template <class Numbers>
[[nodiscard]] inline Numbers lesser(Numbers a, Numbers b) noexcept {
  return a < b ? a : b;
}
/// Returns the greater number, lane by lane.
template <class Numbers>
[[nodiscard]] inline Numbers greater(Numbers a, Numbers b) noexcept {
  return a > b ? a : b;
}

/// Between which values some returns lie: x, y, z, and height above the ground, metres.
struct Extent {
  stage::FourFloats least_m, most_m;

  void add(stage::FourFloats values_m) noexcept {
    least_m = lesser(values_m, least_m);
    most_m = greater(values_m, most_m);
  }
  void add(const Extent& other) noexcept {
    add(other.least_m);
    add(other.most_m);
  }
  [[nodiscard]] float bottom_m() const noexcept { return least_m[3]; }
  [[nodiscard]] float top_m() const noexcept { return most_m[3]; }
};

/// Body cells side by side in a row that belong together, of the same eight cells of the row.
struct Run {
  std::uint32_t begin, end;  ///< Cells [begin, end), which do not cross the seam.
  std::uint32_t cluster;     ///< Its cluster's number.
};

}  // namespace terracut::objects
