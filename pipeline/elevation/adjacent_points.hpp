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

/// How two returns, one above the other, are told to be too steep for ground.
enum class AdjacentRule : std::uint8_t {
  /// Horizontal distance below the bound of Eq. 5, which assumes the lower return on the mount's
  /// plane: Algorithm 1 as printed.
  kRingSpacing,
  /// Measured rise over measured run: the same test without the assumption of a plane.
  kSlope,
};

/// Stage 2: spatiotemporal adjacent points (paper, section III-C, Eq. 3-5, Algorithm 1). Compares
/// every return with those of the next rows up in its own and the neighbouring columns, and calls
/// the upper one (kSlope: both) an obstacle where the step between them is too steep for ground.
class AdjacentPoints {
 public:
  struct Config {
    AdjacentRule rule = AdjacentRule::kSlope;
    float max_slope_rad = 0.70F;  ///< K: the steepest ground, (0, pi/2).
    int first_row_step = 1;      ///< Row steps up from .. to; the paper compares l with l + 2 only.
    int last_row_step = 2;       ///< [first_row_step, 4]
    float row_step_deg = 0.33F;  ///< A row step covers at least this elevation (RowSteps), [0, 5].
    int column_reach = 1;        ///< Columns to each side; "colselzoo" in Algorithm 1; [0, 8].
    float min_rise_m = 0.10F;    ///< kSlope: smaller rises are noise.
    float min_upper_height_m =
        0.04F;  ///< kSlope: the upper return must be this far above the ground reference.
    float min_lower_height_m = 0.02F;  ///< kSlope: above this the lower return is marked as well.
  };

  /// `max_height_m`: a return higher above the ground reference is an obstacle, and a seed of the
  /// min-cut, whether it is steep or not, so that kSlope leaves it alone.
  AdjacentPoints(const Config& config, float max_height_m, const mount::RingProfile& profile,
                 frame::ImageShape shape, memory::FixedMemory& memory);

  // For a frame, also while it arrives (CoarseStages): reset() and compare() columns until all of
  // them are, compare_across_seam(), and mark() what may have become steep.

  /// No return of these columns is steep; their heights are final. Real-time safe, as all of this.
  void reset(frame::ColumnRange columns,
             stage::CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Fills `steep` for the pairs of returns of which one is in these columns and the other in the
  /// same column or one to the left of it.
  void compare(const frame::PointPlanes& points, frame::ColumnRange columns,
               stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// The pairs of which one is in the first columns and the other in the last ones.
  void compare_across_seam(const frame::PointPlanes& points,
                           stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// Frames labels in these columns to kObstacle where they are steep.
  void mark(frame::ColumnRange columns,
            stage::CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Columns to either side that a column is compared with.
  [[nodiscard]] int reach() const noexcept { return config_.column_reach; }

  /// Bound of Eq. 5 for the pair of `row` and the row `row_step` steps up, metres; 0 (no bound)
  /// where the upper beam never reaches the ground.
  [[nodiscard]] float ring_spacing_m(int row, int row_step) const noexcept;

 private:
  /// Calls `visit(rows, Eq. 5's bound)` for all pairs of rows that are compared.
  template <class Visit>
  void for_each_row_pair(const frame::PointPlanes& points, stage::CellPlanes& planes,
                         Visit visit) const noexcept;

  Config config_;
  float max_height_m_;
  frame::ImageShape shape_;
  float tan_max_slope_squared_;
  std::span<float> ring_spacing_m_;    // [row_step - 1][row]
  std::span<std::int32_t> upper_row_;  // likewise: the row that is so many steps up
};

}  // namespace terracut::elevation
