// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/elevation/ground_surface.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// Tells grass, tufts and stubble, which belong to the ground although they rise above the local
/// ground surface, from the feet of objects.
///
/// If nothing tall stands in the grid cells around a return, only ground or something low can have
/// sent it. Unless the return is high enough for an obstacle, its height is set to 0 (levelled), so
/// that no later stage takes a step among such returns for an obstacle. On rough ground the limits
/// are higher. Along a ring heights are good to millimetres: on asphalt, kerbs, walls and metal
/// they bend by 1 to 6 mm from column to column, on grass by 5 to 40 mm.
class RoughGround {
 public:
  struct Config {
    bool enabled = true;     ///< Requires GroundReference::kLocalSurface.
    float tall_m = 0.40F;    ///< A return is tall at this height above the surface.
    int near_sectors = 2;    ///< Sectors within this distance to each side are near.
    int near_bands = 1;      ///< Bands within this distance are near.
    float rough_m = 0.015F;  ///< Ground is rough if most heights in five rows and the near sectors
                             ///< bend by more than this from column to column.
    float rough_tall_m = 0.90F;    ///< On rough ground a return is tall only at this height.
    float rough_height_m = 0.45F;  ///< On rough ground obstacles begin at this height.
  };

  /// Counts the heights of a row in a sector that bend from column to column.
  struct Bends {
    std::int16_t known, rough;  ///< Heights compared; those that bend.
  };

  RoughGround(const Config& config, float obstacle_height_m, const RingGrid& grid,
              frame::ImageShape shape, memory::FixedMemory& memory);

  /// Returns how many sectors to each side must be complete before a sector can be levelled.
  [[nodiscard]] int reach() const noexcept { return config_.enabled ? near_sectors_ : 0; }

  // Order of calls for a frame: reset(), find_highest_near() for sectors, then level() for each row
  // of the columns in these sectors.

  /// Begins a frame. All functions of this class are real-time safe.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// Finds the highest return near each grid cell of these sectors. `highest_m` is the highest
  /// return and `ground` the ground in each cell of the grid.
  void find_highest_near(
      RingGrid::Sectors sectors, const RingGrid& grid, std::span<const float> highest_m,
      std::span<const GroundSurface::EdgeHeights> ground) noexcept TERRACUT_NONBLOCKING;
  /// Returns the height of the highest return near each grid cell, above the ground in the cell.
  [[nodiscard]] std::span<const float> highest_near_m() const noexcept { return highest_near_m_; }
  /// Levels the heights of a row in these columns; `highest_m` is the highest return near each
  /// column, above ground. All points in reach() of the columns' sectors must be complete.
  void level(const frame::PointPlanes& points, int row, frame::ColumnRange columns,
             std::span<const float> highest_m, const RingGrid& grid,
             std::span<float> height_m) noexcept TERRACUT_NONBLOCKING;

 private:
  [[nodiscard]] static std::size_t place(const RingGrid& grid, int row, int sector) noexcept {
    return static_cast<std::size_t>(row * grid.sectors() + sector);
  }
  enum Answer : std::uint8_t { kNotAsked, kNo, kYes };

  [[nodiscard]] bool is_rough(const frame::PointPlanes& points, const RingGrid& grid, int row,
                              int sector) noexcept;
  /// Returns the bends of a row, summed over a sector and the sectors near it.
  [[nodiscard]] Bends bends_beside(const frame::PointPlanes& points, const RingGrid& grid, int row,
                                   int sector) noexcept;
  [[nodiscard]] Bends bends_of(const frame::PointPlanes& points, const RingGrid& grid, int row,
                               int sector) noexcept;

  Config config_;
  float obstacle_height_m_;
  frame::ImageShape shape_;
  int near_sectors_;
  std::span<float> highest_near_m_;       // by grid cell, above the ground in the cell
  std::span<std::uint8_t> may_be_rough_;  // by column: 1 if levelled only on rough ground
  // One element per row and sector, computed on demand.
  std::span<Bends> bends_;         // `known` is -1 before the element is computed
  std::span<Bends> bends_beside_;  // `known` is -1 before the element is computed
  std::span<Answer> is_rough_;
};

}  // namespace terracut::elevation
