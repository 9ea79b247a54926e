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

/// Tells grass, tufts and stubble from the feet of objects: low things that belong to the ground
/// although they rise above the local ground surface.
///
/// If nothing tall stands in the grid cells around a return, only ground or something low can have
/// sent it. Unless its height makes it an obstacle, its height is then set to 0 (it is level), so
/// that no later stage takes a step among such returns for an obstacle. On rough ground the limits
/// are higher. Along a ring heights are good to millimetres: asphalt, kerbs, walls and metal bend
/// by 1 to 6 mm from column to column, grass by 5 to 40.
class RoughGround {
 public:
  struct Config {
    bool enabled = true;     ///< Needs the local ground surface.
    float tall_m = 0.40F;    ///< Tall: so high above the surface.
    int near_sectors = 2;    ///< Near: at most so many sectors aside.
    int near_bands = 1;      ///< Near: at most so many bands nearer or farther.
    float rough_m = 0.015F;  ///< Rough: most heights, in five rows and the sectors near, bend by
                             ///< more than this from column to column.
    float rough_tall_m = 0.90F;    ///< On rough ground only this is tall.
    float rough_height_m = 0.45F;  ///< On rough ground obstacles begin at this height.
  };

  /// Counts of a sector's heights in a row that bend between columns.
  struct Bends {
    std::int16_t known, rough;  ///< `rough` ones bend by more than `rough_m`.
  };

  RoughGround(const Config& config, float obstacle_height_m, const RingGrid& grid,
              frame::ImageShape shape, memory::FixedMemory& memory);

  /// Returns how many sectors to either side must be complete before a sector is levelled.
  [[nodiscard]] int reach() const noexcept { return config_.enabled ? near_sectors_ : 0; }

  // Order of calls for a frame: reset(), find_highest_near() for sectors, then level() for rows of
  // their columns.

  /// Real-time safe, like all functions here.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// Finds the highest return near each grid cell of these sectors. `highest_m` is the highest
  /// return and `ground` the ground in each cell of the grid.
  void find_highest_near(
      RingGrid::Sectors sectors, const RingGrid& grid, std::span<const float> highest_m,
      std::span<const GroundSurface::EdgeHeights> ground) noexcept TERRACUT_NONBLOCKING;
  /// Returns the highest return near each grid cell, above the cell's ground.
  [[nodiscard]] std::span<const float> highest_near_m() const noexcept { return highest_near_m_; }
  /// Levels the heights of a row in these columns, where `highest_m` is the highest return near
  /// each, above the ground. All points of their sectors and those within reach must be complete.
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
  /// Returns the bends of a row in a sector and those near it.
  [[nodiscard]] Bends bends_beside(const frame::PointPlanes& points, const RingGrid& grid, int row,
                                   int sector) noexcept;
  [[nodiscard]] Bends bends_of(const frame::PointPlanes& points, const RingGrid& grid, int row,
                               int sector) noexcept;

  Config config_;
  float obstacle_height_m_;
  frame::ImageShape shape_;
  int near_sectors_;
  std::span<float> highest_near_m_;       // by grid cell, above its ground
  std::span<std::uint8_t> may_be_rough_;  // by column: to level only on rough ground
  // By row and sector, computed on demand.
  std::span<Bends> bends_;         // `known` is -1 before
  std::span<Bends> bends_beside_;  // likewise
  std::span<Answer> is_rough_;
};

}  // namespace terracut::elevation
