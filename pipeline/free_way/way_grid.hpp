// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/free_way/sector.hpp"

namespace terracut::free_way {

/// What is known of a cell of a grid; the numbers are those of nav_msgs/OccupancyGrid.
enum class Cell : std::int8_t { kUnknown = -1, kFree = 0, kOccupied = 100 };

/// The free way in square cells around the vehicle: free where ground was seen up to the cell's
/// middle and nothing stands before; occupied where the nearest obstacle of a sector, or the edge
/// of a drop before it, lies; all else unknown.
struct WayGrid {
  static constexpr float kCell_m = 0.2F;
  static constexpr std::size_t kSide = 200;  ///< Cells along either side.
  /// Coordinates of the first cell's corner, vehicle frame; both x and y.
  static constexpr float kFirst_m = -kCell_m * static_cast<float>(kSide) / 2;

  std::vector<Cell> cells = std::vector<Cell>(kSide * kSide);  ///< x first, row after row of y.

  /// Replaces the cells by those of these sectors.
  void fill(std::span<const Sector> sectors);
};

}  // namespace terracut::free_way
