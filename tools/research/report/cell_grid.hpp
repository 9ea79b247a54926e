// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::report {

/// Where a return meets the ground.
struct GroundPlace {
  float x_m = 0, y_m = 0;
  float ground_range_m = 0;
  int column = 0;  ///< Of the range image.
};

/// A division of the ground into cells over which returns can be counted.
class CellGrid {
 public:
  virtual ~CellGrid() = default;

  /// The cell of a place; none outside the grid.
  [[nodiscard]] virtual std::optional<std::size_t> cell_of(const GroundPlace& place) const = 0;
  /// Distance of every cell's middle from the sensor, metres.
  [[nodiscard]] const std::vector<float>& centre_range_m() const noexcept {
    return centre_range_m_;
  }

 protected:
  std::vector<float> centre_range_m_;
};

/// Squares of one size: what the paper sets its rings against (Fig. 2).
class SquareGrid final : public CellGrid {
 public:
  /// Covers [-extent_m, extent_m] in x and y with squares of side_m.
  SquareGrid(float side_m, float extent_m);
  [[nodiscard]] std::optional<std::size_t> cell_of(const GroundPlace& place) const override;

 private:
  float side_m_, extent_m_;
  std::size_t squares_;  ///< Along a side.
};

/// The grid of the ring-based elevation map (Fig. 3).
class RingCells final : public CellGrid {
 public:
  RingCells(const elevation::RingGrid::Config& config, const mount::RingProfile& profile,
            frame::ImageShape shape);
  [[nodiscard]] std::optional<std::size_t> cell_of(const GroundPlace& place) const override;

 private:
  memory::FixedMemory memory_;
  elevation::RingGrid grid_;
};

/// Where the lasers meet a ground that is flat, empty and level: what the paper's Eq. 1 and 2
/// count.
[[nodiscard]] std::vector<GroundPlace> flat_world(const mount::RingProfile& profile,
                                                  frame::ImageShape shape);

}  // namespace terracut::report
