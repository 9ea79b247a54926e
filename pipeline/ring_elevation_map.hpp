// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/cell_planes.hpp"
#include "pipeline/ground_surface.hpp"
#include "pipeline/range_image.hpp"
#include "pipeline/ring_grid.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

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
    float obstacle_height_m = 0.15F;  ///< A return this far above its reference is an obstacle.
  };

  RingElevationMap(const Config& config, const calib::RingProfile& profile, ImageShape shape,
                   rt::FixedMemory& memory);

  /// Fills `height_m` and `label` of every cell. Real-time safe.
  void segment(const RangeImage& image, CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const RingGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] const GroundSurface& surface() const noexcept { return surface_; }

 private:
  void find_lowest_returns(const RangeImage& image) noexcept;
  void label_by_cell_minimum(const RangeImage& image, CellPlanes& planes) const noexcept;
  void label_by_local_surface(const RangeImage& image, CellPlanes& planes) const noexcept;

  Config config_;
  RingGrid grid_;
  GroundSurface surface_;
  std::span<GroundSurface::LowestReturn> lowest_;  // per grid cell
  std::span<std::int64_t> lowest_key_;             // the same while it is being found
  // Of one row, by column: its returns' keys, and their ranges in the grid's steps.
  std::span<std::int64_t> row_keys_;
  std::span<std::uint16_t> row_steps_;
};

}  // namespace terracut::pipeline
