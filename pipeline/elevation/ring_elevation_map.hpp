// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware_io/frame/frame_returns.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/elevation/ground_surface.hpp"
#include "pipeline/elevation/lone_returns.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "pipeline/elevation/row_opening.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// The reference from which a return's height is measured.
enum class GroundReference : std::uint8_t {
  kCellMinimum,   ///< The lowest return of the cell: the paper assumes flat cells.
  kLocalSurface,  ///< The local ground surface (ground_surface.hpp).
};

/// Stage 1, coarse segmentation: the ring-based elevation map (paper, section III-B).
class RingElevationMap {
 public:
  struct Config {
    RingGrid::Config grid;
    GroundReference reference = GroundReference::kLocalSurface;
    GroundSurface::Config surface;    ///< Used with kLocalSurface.
    RowOpening::Config opening;       ///< Used with kLocalSurface.
    float lone_depth_m = 0.10F;       ///< Depth of LoneReturns, used with kLocalSurface.
    float obstacle_height_m = 0.15F;  ///< A return this far above its reference is an obstacle.
  };
  /// Two numbers that encode a cell's extreme returns: the first is smaller the lower the lowest
  /// return and tells its row, the second is smaller the higher the highest return.
  using Extremes = double __attribute__((vector_size(16)));

  RingElevationMap(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
                   memory::FixedMemory& memory);

  // Order of calls for a frame, which may still be arriving (CoarseStages): reset(); take_to() for
  // sector after sector; label() for sectors that are settled.

  /// Begins a frame. All functions of this class are real-time safe.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// Takes a return that shares its cell with another return, if frames keep returns as measured.
  void take_extra(int column, float z_m, float ground_range_m) noexcept TERRACUT_NONBLOCKING;
  /// Takes the sectors from taken() to `end`, whose columns must be complete, and settles those
  /// whose ground is known by now. `points` has the returns that own their cells; other returns are
  /// in an image's overflow list or came by take_extra().
  void take_to(int end, const frame::FrameReturns& frame,
               const frame::PointPlanes& points) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] int taken() const noexcept { return taken_.next; }
  /// Returns false if a return came after its sector was taken, which makes the result invalid.
  /// Call it once all sectors have been taken.
  [[nodiscard]] bool saw_all_of(const frame::FrameReturns& frame) const noexcept {
    return !was_overtaken_ && seen_ + seen_overflow_ == frame.returns();
  }
  /// Returns the sectors whose ground is known. They are numbered on beyond the last sector: the
  /// ground of the first ones depends on the last, so these come at the end.
  [[nodiscard]] RingGrid::Sectors settled() const noexcept {
    return {settled_.begin, settled_.next};
  }
  /// Fills `height_m` and `label` in these columns, which must be of settled sectors.
  void label(const frame::PointPlanes& points, frame::ColumnRange columns,
             stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const RingGrid& grid() const noexcept { return grid_; }

 private:
  [[nodiscard]] bool has_surface() const noexcept {
    return config_.reference == GroundReference::kLocalSurface;
  }
  void take_overflow(const frame::RangeImage& image) noexcept;
  void take_columns(const frame::PointPlanes& points, RingGrid::Sectors sectors) noexcept;
  /// Lets each step go on as far as the step before it has come.
  void settle() noexcept;
  void find_lowest(int sector) noexcept;
  /// Labels what stands out of a row obstacle.
  void label_standing_out(const float* z_m, int row, frame::ColumnRange columns,
                          frame::Label* label) const noexcept;

  Config config_;
  frame::ImageShape shape_;
  RingGrid grid_;
  GroundSurface surface_;
  LoneReturns lone_;
  RowOpening opening_;
  int rows_with_lone_;  // number of rows, from the lowest, whose lone returns are looked for
  /// How far a step has come on its way around the circle, in sectors.
  struct Progress {
    int begin = 0, next = 0, end = 0;

    /// Returns where a step must stop that needs `ahead` sectors of this one beyond its own.
    [[nodiscard]] int stop_of_next_step(int ahead) const noexcept {
      return next == end ? std::numeric_limits<int>::max() : next - ahead;
    }
  };
  Progress taken_, traced_, given_, settled_;  // in this order; given_: donors are found
  bool settles_at_end_ = false;                // true for circles of few sectors
  std::size_t seen_ = 0;  // number of returns in the taken sectors that own a cell
  // Number of returns that own no cell: from the overflow list or take_extra().
  std::size_t seen_overflow_ = 0;
  bool was_overtaken_ = false;
  // One element per grid cell; during the search extremes_ has lowest and highest returns.
  std::span<GroundSurface::LowestReturn> lowest_;
  std::span<Extremes> extremes_;
  // Work space for one row, from the first column in work: the extremes of its returns in halves,
  // their ranges in steps of the grid, and their heights without lone returns.
  std::span<std::uint32_t> row_halves_;
  std::span<std::uint16_t> row_steps_;
  std::span<float> row_kept_m_;
};

}  // namespace terracut::elevation
