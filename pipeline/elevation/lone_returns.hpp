// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// Finds returns that lie alone below their row: ghosts, which wet roads, glass and second
/// reflections send from behind or below the surface that the beam met.
///
/// Ground that is really lower is seen by returns side by side. A return is alone if it lies more
/// than a depth below one of the two returns to either side of it, and none of these lies within
/// half that depth of its height. Only returns of the same sector of the grid are compared, so that
/// nothing depends on which columns have arrived.
class LoneReturns {
 public:
  LoneReturns(float depth_m, const RingGrid& grid, frame::ImageShape shape,
              memory::FixedMemory& memory);

  /// Copies the heights of a row in `columns`, whole sectors, to `kept_m`, lone returns as NaN;
  /// `z_m` starts at the row's first column. Real-time safe.
  void take_out(const float* z_m, frame::ColumnRange columns,
                std::span<float> kept_m) const noexcept TERRACUT_NONBLOCKING;

 private:
  static constexpr int kReach = 2;  // columns compared to either side
  static constexpr int kOffsets[2 * kReach] = {-2, -1, 1, 2};

  float depth_m_;
  // By offset (kOffsets) and column: 0 if the column that far to the right is in the same sector,
  // else NaN.
  std::span<float> apart_[2 * kReach];
};

}  // namespace terracut::elevation
