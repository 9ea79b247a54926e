// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/elevation/ground_surface.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "pipeline/elevation/rough_ground.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// What a return's height is measured from.
enum class GroundReference : std::uint8_t {
  kCellMinimum,   ///< The lowest return of its grid cell: the paper's flat-cell assumption.
  kLocalSurface,  ///< The local ground surface (ground_surface.hpp).
};

/// Stage 1, coarse segmentation: the ring-based elevation map (paper, section III-B).
class RingElevationMap {
 public:
  struct Config {
    RingGrid::Config grid;
    GroundReference reference = GroundReference::kLocalSurface;
    GroundSurface::Config surface;    ///< Used with kLocalSurface.
    RoughGround::Config rough;        ///< Used with kLocalSurface.
    float obstacle_height_m = 0.15F;  ///< A return this far above its reference is an obstacle.
  };
  /// Two numbers, the less the lower the lowest return of a grid cell and the higher the highest.
  using Extremes = double __attribute__((vector_size(16)));

  RingElevationMap(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
                   memory::FixedMemory& memory);

  // For a frame, also while it arrives (CoarseStages): reset(), then trace_to() sector after
  // sector, finalize() what is to be labelled already, finalize_rest() when all have been traced,
  // and label() what was final before.

  /// A new frame. Real-time safe, as all of this.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// Of frames that keep their returns as they were measured: one that does not own its cell.
  void take_extra(int column, float z_m, float ground_range_m) noexcept TERRACUT_NONBLOCKING;
  /// All columns of the sectors from traced() to `end` are there: `points` has those returns that
  /// own their cells, the others are in the image's overflow list or were told by take_extra().
  void trace_to(int end, const frame::RangeImage& image,
                const frame::PointPlanes& points) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] int traced() const noexcept { return traced_; }
  /// False where a return came after its sector had been traced: what was found is of no use then.
  /// Once all sectors have been traced.
  [[nodiscard]] bool saw_all_of(const frame::RangeImage& image) const noexcept {
    return !was_overtaken_ && seen_ + seen_overflow_ == image.returns();
  }
  void finalize(RingGrid::Sectors sectors) noexcept TERRACUT_NONBLOCKING;
  /// As GroundSurface::finalize_rest().
  void finalize_rest(std::span<std::uint8_t> is_current) noexcept TERRACUT_NONBLOCKING;
  /// Sectors to either side that have to be traced for a sector to be final.
  [[nodiscard]] int reach() const noexcept {
    return has_surface() ? std::max(surface_.reach(), rough_.reach()) : 0;
  }
  /// Fills `height_m` and `label` of some columns.
  void label(const frame::PointPlanes& points, frame::ColumnRange columns,
             stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const RingGrid& grid() const noexcept { return grid_; }

 private:
  [[nodiscard]] bool has_surface() const noexcept {
    return config_.reference == GroundReference::kLocalSurface;
  }
  void take_overflow(const frame::RangeImage& image) noexcept;
  void take_columns(const frame::PointPlanes& points, RingGrid::Sectors sectors) noexcept;

  Config config_;
  frame::ImageShape shape_;
  RingGrid grid_;
  GroundSurface surface_;
  RoughGround rough_;
  int traced_ = 0;        // sectors
  std::size_t seen_ = 0;  // returns that own a cell of these
  // Returns that own none: all of the overflow list, or those told of.
  std::size_t seen_overflow_ = 0;
  bool was_overtaken_ = false;
  // Per grid cell, the lowest return and the height of the highest; before, while they are looked
  // for, both.
  std::span<GroundSurface::LowestReturn> lowest_;
  std::span<Extremes> extremes_;
  std::span<float> highest_m_;
  // Of one row, from the first column at hand: halves of its returns' extremes, their ranges in the
  // grid's steps, and the highest return near each.
  std::span<std::uint32_t> row_halves_;
  std::span<std::uint16_t> row_steps_;
  std::span<float> row_highest_m_;
};

}  // namespace terracut::elevation
