// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "pipeline/ring_grid.hpp"
#include "rt/fixed_memory.hpp"

namespace terracut::pipeline {

/// The local ground surface over a ring grid, from the lowest return of every grid cell.
///
/// Departs from the paper, which takes the lowest return of a cell for the ground whatever it is:
/// there a car that hides the ground becomes ground. Here each sector is walked from the vehicle
/// outwards; the lowest return of a cell is ground only if a passable slope leads to it from the
/// ground before, and cells without ground of their own borrow from the nearest sectors that have it.
class GroundSurface {
 public:
  struct Config {
    float step_up_m = 0.08F;       ///< Rise accepted at no distance at all (noise, bumps).
    float slope_tolerance = 0.12F; ///< Further rise or fall accepted per metre walked.
    float step_up_limit_m = 0.31F; ///< Never accept a rise above this, however far the last ground.
    float extra_fall = 0.30F;      ///< Further fall accepted per metre walked (ground may drop away).
    float slope_gain = 0.30F;      ///< Share of a new step in the running slope, (0, 1].
    float max_slope = 0.20F;       ///< Largest running slope, rise over run.
    float slope_memory_m = 2.0F;   ///< How far the running slope is carried on over missing ground.
    float first_slope_run_m = 1.0F;///< A shorter step than this counts as this long for the slope.
    int borrow_sectors = 10;       ///< How many sectors to each side a cell may borrow from.
    float walked_weight = 0.30F;   ///< Weight of the walked prediction against a neighbour's 1/distance.
  };

  GroundSurface(const Config& config, const RingGrid& grid, rt::FixedMemory& memory);

  /// Estimates the surface from `lowest_m`, one height per grid cell, kEmpty where it had no return.
  /// Real-time safe.
  void estimate(const RingGrid& grid, std::span<const float> lowest_m) noexcept;

  /// Ground height above the mount's plane, one per grid cell, defined everywhere.
  [[nodiscard]] std::span<const float> height_m() const noexcept { return height_m_; }

  static constexpr float kEmpty = 1e9F;

 private:
  void walk_outwards(const RingGrid& grid, int sector, std::span<const float> lowest_m) noexcept;
  void borrow_from_neighbours(const RingGrid& grid) noexcept;

  Config config_;
  std::span<float> walked_m_;
  std::span<float> height_m_;
  std::span<std::uint8_t> measured_;  // 1 where the cell's own lowest return is the ground
};

}  // namespace terracut::pipeline
