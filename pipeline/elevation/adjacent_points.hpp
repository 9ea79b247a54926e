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

/// The rule by which the step between two returns, one above the other, is too steep for ground.
enum class AdjacentRule : std::uint8_t {
  /// Too steep if the horizontal distance is below the bound of Eq. 5, which assumes that the lower
  /// return lies on the mount's plane. This is Algorithm 1 as printed.
  kRingSpacing,
  /// Too steep if measured rise over measured run is too large; no plane is assumed.
  kSlope,
};

/// Stage 2: spatiotemporal adjacent points (paper, section III-C, Eq. 3-5, Algorithm 1). Compares
/// every return with the next rows' returns in the same and neighbouring columns. If the step
/// between two returns is too steep for ground, the upper one (kSlope: both) is an obstacle.
class AdjacentPoints {
 public:
  struct Config {
    AdjacentRule rule = AdjacentRule::kSlope;
    float max_slope_rad = 0.75F;  ///< Slope of the steepest ground (K in the paper), (0, pi/2).
    int first_row_step = 1;       ///< Lowest row step compared; the paper compares l + 2 only.
    int last_row_step = 2;        ///< Highest row step compared, [first_row_step, 4].
    float row_step_deg = 0.33F;   ///< Least elevation that a row step covers (RowSteps), [0, 5].
    int column_reach = 1;      ///< Columns compared to each side, [0, 8]; "colselzoo" in the paper.
    float min_rise_m = 0.10F;  ///< kSlope ignores smaller rises as noise.
    float min_upper_height_m = 0.04F;  ///< kSlope: least height of the upper return above ground.
    float min_lower_height_m = 0.02F;  ///< kSlope also marks lower returns above this height.
  };

  /// A return higher than `max_height_m` above the ground reference is an obstacle and a seed of
  /// the min-cut, whether steep or not; so kSlope ignores returns that high.
  AdjacentPoints(const Config& config, float max_height_m, const mount::RingProfile& profile,
                 frame::ImageShape shape, memory::FixedMemory& memory);

  // Order of calls for columns: reset(), compare() and, for those that begin a turn,
  // compare_across_seam(), then mark() for the columns that may have become steep.

  /// Clears `steep` in these columns; the heights in them must be final. All functions of this
  /// class are real-time safe.
  void reset(frame::ColumnRange columns,
             stage::CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Sets `steep` for pairs of returns with one return in these columns and the other in the same
  /// column or a column to the left, on this side of the seam.
  void compare(const frame::PointPlanes& points, frame::ColumnRange columns,
               stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// Sets `steep` for pairs with one return in the last columns and one in the first.
  void compare_across_seam(const frame::PointPlanes& points,
                           stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// Labels the steep returns of these columns kObstacle.
  void mark(frame::ColumnRange columns,
            stage::CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Returns how many columns to either side a column is compared with.
  [[nodiscard]] int reach() const noexcept { return config_.column_reach; }

  /// Returns the bound of Eq. 5, in metres, for `row` and the row `row_step` steps up; 0 (no bound)
  /// if the upper beam never reaches the ground.
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
  std::span<std::int32_t> upper_row_;  // [row_step - 1][row]: row + row_step
};

}  // namespace terracut::elevation
