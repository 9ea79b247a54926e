// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// When the step between two returns, one above the other, is too steep for ground.
enum class AdjacentRule : std::uint8_t {
  /// If the horizontal distance is below the bound of Eq. 5, which assumes the lower return on the
  /// mount's plane: Algorithm 1 as printed.
  kRingSpacing,
  /// If measured rise over measured run is too large: the same test without assuming a plane.
  kSlope,
};

/// Stage 2: spatiotemporal adjacent points (paper, section III-C, Eq. 3-5, Algorithm 1). Compares
/// every return with those of the next rows up in its own and the neighbouring columns. If the step
/// between them is too steep for ground, the upper one (kSlope: both) is an obstacle.
class AdjacentPoints {
 public:
  struct Config {
    AdjacentRule rule = AdjacentRule::kSlope;
    float max_slope_rad = 0.70F;  ///< K: the steepest ground, (0, pi/2).
    int first_row_step = 1;       ///< The lowest row step compared; the paper has l + 2 only.
    int last_row_step = 2;        ///< The highest, [first_row_step, 4].
    float row_step_deg = 0.33F;   ///< A row step covers at least this elevation (RowSteps), [0, 5].
    int column_reach = 1;         ///< Columns to each side; "colselzoo" in Algorithm 1; [0, 8].
    float min_rise_m = 0.10F;     ///< kSlope: smaller rises count as noise.
    float min_upper_height_m = 0.04F;  ///< kSlope: least height of the upper return above ground.
    float min_lower_height_m = 0.02F;  ///< kSlope: a lower return above this is marked, too.
  };

  /// A return higher than `max_height_m` above the ground reference is an obstacle, and a seed of
  /// the min-cut, whether steep or not; kSlope therefore ignores it.
  AdjacentPoints(const Config& config, float max_height_m, const mount::RingProfile& profile,
                 frame::ImageShape shape, memory::FixedMemory& memory);

  // Order of calls for a frame, which may still be arriving (CoarseStages): reset() and compare()
  // all columns, compare_across_seam(), then mark() those that may have become steep.

  /// Clears `steep` in these columns; their heights must be final. Real-time safe, like all
  /// functions here.
  void reset(frame::ColumnRange columns,
             stage::CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Sets `steep` for pairs with one return in these columns and the other in the same column or to
  /// its left.
  void compare(const frame::PointPlanes& points, frame::ColumnRange columns,
               stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// Sets `steep` for pairs with one return in the first columns and the other in the last ones.
  void compare_across_seam(const frame::PointPlanes& points,
                           stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// Sets steep returns of these columns to kObstacle.
  void mark(frame::ColumnRange columns,
            stage::CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Returns how many columns to either side a column is compared with.
  [[nodiscard]] int reach() const noexcept { return config_.column_reach; }

  /// Returns the bound of Eq. 5 for `row` and the row `row_step` steps up, metres; 0 (no bound) if
  /// the upper beam never reaches the ground.
  [[nodiscard]] float ring_spacing_m(int row, int row_step) const noexcept;

 private:
  /// Calls `visit(rows, bound of Eq. 5)` for all pairs of rows that are compared.
  template <class Visit>
  void for_each_row_pair(const frame::PointPlanes& points, stage::CellPlanes& planes,
                         Visit visit) const noexcept;

  Config config_;
  float max_height_m_;
  frame::ImageShape shape_;
  float tan_max_slope_squared_;
  std::span<float> ring_spacing_m_;    // [row_step - 1][row]
  std::span<std::int32_t> upper_row_;  // [row_step - 1][row]: the row so many steps up
};

}  // namespace terracut::elevation
