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
    RoughGround::Config rough;        ///< Used with kLocalSurface.
    float obstacle_height_m = 0.15F;  ///< A return this far above its reference is an obstacle.
  };
  /// Two numbers that encode a cell's extreme returns: the first is smaller the lower the lowest
  /// return, the second is smaller the higher the highest return.
  using Extremes = double __attribute__((vector_size(16)));

  RingElevationMap(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
                   memory::FixedMemory& memory);

  // Order of calls for a frame, which may still be arriving (CoarseStages): reset(); trace_to() for
  // sector after sector; finalize() for sectors to be labelled early; finalize_rest() when all
  // sectors are traced. label() may be called for every final sector.

  /// Begins a frame. All functions of this class are real-time safe.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// Takes a return that shares its cell with another return, if frames keep returns as measured.
  void take_extra(int column, float z_m, float ground_range_m) noexcept TERRACUT_NONBLOCKING;
  /// Traces the sectors from traced() to `end`; the columns of these sectors must be complete.
  /// `points` has the returns that own their cells; other returns are in the image's overflow list
  /// or came by take_extra().
  void trace_to(int end, const frame::RangeImage& image,
                const frame::PointPlanes& points) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] int traced() const noexcept { return traced_; }
  /// Returns false if a return came after its sector was traced, which makes the result invalid.
  /// Call it once all sectors have been traced.
  [[nodiscard]] bool saw_all_of(const frame::RangeImage& image) const noexcept {
    return !was_overtaken_ && seen_ + seen_overflow_ == image.returns();
  }
  void finalize(RingGrid::Sectors sectors) noexcept TERRACUT_NONBLOCKING;
  /// Calls GroundSurface::finalize_rest().
  void finalize_rest(std::span<std::uint8_t> is_current) noexcept TERRACUT_NONBLOCKING;
  /// Returns how many sectors to either side must be traced before a sector is final.
  [[nodiscard]] int reach() const noexcept {
    return has_surface() ? std::max(surface_.reach(), rough_.reach()) : 0;
  }
  /// Fills `height_m` and `label` in these columns.
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
  int traced_ = 0;        // number of sectors traced
  std::size_t seen_ = 0;  // number of returns in the traced sectors that own a cell
  // Number of returns that own no cell: from the overflow list or take_extra().
  std::size_t seen_overflow_ = 0;
  bool was_overtaken_ = false;
  // One element per grid cell; during the search extremes_ has lowest and highest returns.
  std::span<GroundSurface::LowestReturn> lowest_;
  std::span<Extremes> extremes_;
  std::span<float> highest_m_;
  // Work space for one row, from the first column in work: the extremes of its returns in halves,
  // their ranges in steps of the grid, and the highest return near each return.
  std::span<std::uint32_t> row_halves_;
  std::span<std::uint16_t> row_steps_;
  std::span<float> row_highest_m_;
};

}  // namespace terracut::elevation
