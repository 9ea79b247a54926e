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

/// Tells grass, tufts and stubble from the feet of things: what belongs to the ground although it
/// rises above the local ground surface.
///
/// Where nothing tall stands in the grid cells around a return, only ground or something low can
/// have sent it. If it is no obstacle by its height, it is level: its height counts no further, so
/// that no later stage takes a step among such returns for an obstacle. Rough ground may be higher,
/// and what stands on it, too. Along a ring heights are good to millimetres: asphalt, kerbs, walls
/// and metal bend by 1 to 6 mm from column to column, grass by 5 to 40.
class RoughGround {
 public:
  struct Config {
    bool enabled = true;     ///< Needs the local ground surface.
    float tall_m = 0.40F;    ///< Something so high above the surface is tall ...
    int near_sectors = 2;    ///< ... and near if it is so many sectors aside or fewer ...
    int near_bands = 1;      ///< ... and as many bands nearer or farther.
    float rough_m = 0.015F;  ///< Where most heights bend by more than this from column to column
                             ///< (of five rows and the sectors near) it is rough: there ...
    float rough_tall_m = 0.90F;    ///< ... only something so high is tall ...
    float rough_height_m = 0.45F;  ///< ... and obstacles begin so high above the surface.
  };

  /// How many heights of a sector in a row bend from one column to the next.
  struct Bends {
    std::int16_t known, rough;  ///< by more than `rough_m`
  };

  RoughGround(const Config& config, float obstacle_height_m, const RingGrid& grid,
              frame::ImageShape shape, memory::FixedMemory& memory);

  /// Sectors to either side that have to be there before a sector is levelled.
  [[nodiscard]] int reach() const noexcept { return config_.enabled ? near_sectors_ : 0; }

  // Of a frame: reset(), then of sectors find_highest_near() and of rows of their columns level().

  /// Real-time safe, as all of this.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// What is near to the grid cells of these sectors: `highest_m` is the highest return and
  /// `ground` the ground in each cell of the grid.
  void find_highest_near(
      RingGrid::Sectors sectors, const RingGrid& grid, std::span<const float> highest_m,
      std::span<const GroundSurface::EdgeHeights> ground) noexcept TERRACUT_NONBLOCKING;
  /// Of each cell of the grid, the highest return near it, above its ground.
  [[nodiscard]] std::span<const float> highest_near_m() const noexcept { return highest_near_m_; }
  /// Levels the heights of a row in these columns, near each of which the highest return is
  /// `highest_m` above the ground. All points of their sectors and of those in reach are there.
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
  /// Of a row, in a sector and those near.
  [[nodiscard]] Bends bends_beside(const frame::PointPlanes& points, const RingGrid& grid, int row,
                                   int sector) noexcept;
  [[nodiscard]] Bends bends_of(const frame::PointPlanes& points, const RingGrid& grid, int row,
                               int sector) noexcept;

  Config config_;
  float obstacle_height_m_;
  frame::ImageShape shape_;
  int near_sectors_;
  std::span<float> highest_near_m_;       // by grid cell, above its ground
  std::span<std::uint8_t> may_be_rough_;  // of a row: too high to be level unless it is rough there
  // By row and sector, found where they are asked for.
  std::span<Bends> bends_;         // known: -1 before
  std::span<Bends> bends_beside_;  // as that
  std::span<Answer> is_rough_;
};

}  // namespace terracut::elevation
