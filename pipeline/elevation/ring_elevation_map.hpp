// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
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

  // Order of calls for a turn of the sensor: take_to() as its sectors come, and label() for sectors
  // that are settled; at its end settle_until(), if what comes next is not waited for, and
  // begin_next_turn(). Sectors are numbered from the beginning of the turn; those of the turn
  // before it have numbers below 0.

  /// Forgets all turns and begins one. All functions of this class are real-time safe.
  void begin() noexcept TERRACUT_NONBLOCKING;
  void begin_next_turn() noexcept TERRACUT_NONBLOCKING;
  /// Takes a return that owns no cell. Leaves it out if it comes late, after its sector was traced.
  void take_extra(int column, float z_m, float ground_range_m) noexcept TERRACUT_NONBLOCKING;
  /// Takes the sectors from taken() to `end`, whose columns must be complete. `points` has the
  /// returns that own their cells.
  void take_to(int end, const frame::PointPlanes& points) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] int taken() const noexcept { return taken_; }
  /// Settles the sectors whose ground is known by now: all but the newest of those taken, on which
  /// it depends. For turns that follow a whole turn.
  void settle() noexcept TERRACUT_NONBLOCKING;
  /// Settles the sectors before this one, which must be taken. What is not taken yet is seen as it
  /// was a turn before; behind the first turn's first sector lies its last one.
  void settle_until(int sector) noexcept TERRACUT_NONBLOCKING;
  /// Sectors before this one are settled.
  [[nodiscard]] int settled() const noexcept { return settled_; }
  /// True if the circle has more sectors than one sector's ground depends on.
  [[nodiscard]] bool can_go_on() const noexcept TERRACUT_NONBLOCKING;

  /// Fills `height_m` and `label` in these columns, which must be of settled sectors.
  void label(const frame::PointPlanes& points, frame::ColumnRange columns,
             stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  /// Returns how high a return lies above the ground; its column must have been labelled.
  [[nodiscard]] float height_of(int column, float z_m,
                                float ground_range_m) const noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const RingGrid& grid() const noexcept { return grid_; }

 private:
  [[nodiscard]] bool has_surface() const noexcept {
    return config_.reference == GroundReference::kLocalSurface;
  }
  void take_columns(const frame::PointPlanes& points, RingGrid::Sectors sectors) noexcept;
  /// Lets each step go on to a sector, or as far as the step before it has come.
  void settle_to(int traced, int given, int settled) noexcept;
  void trace(int sector) noexcept;
  void find_lowest(int sector) noexcept;
  /// Labels what stands out of a row obstacle.
  void label_standing_out(const float* z_m, int row, frame::ColumnRange columns,
                          frame::Label* label) noexcept;

  Config config_;
  frame::ImageShape shape_;
  RingGrid grid_;
  GroundSurface surface_;
  LoneReturns lone_;
  RowOpening opening_;
  int rows_with_lone_;  // number of rows, from the lowest, whose lone returns are looked for
  // How far each step has come; each follows the one before it. given_: donors are found.
  int taken_ = 0, traced_ = 0, given_ = 0, settled_ = 0;
  // One element per grid cell; extremes_ has the lowest and highest returns of sectors that are not
  // traced yet.
  std::span<GroundSurface::LowestReturn> lowest_;
  std::span<Extremes> extremes_;
  // Work space for one row, from the first column in work: the extremes of its returns in halves,
  // their ranges in steps of the grid, and their heights without lone returns.
  std::span<std::uint32_t> row_halves_;
  std::span<std::uint16_t> row_steps_;
  std::span<float> row_kept_m_;
};

}  // namespace terracut::elevation
