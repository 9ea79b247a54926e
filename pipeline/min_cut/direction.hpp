// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/frame/range_image.hpp"

namespace terracut::min_cut {

/// The 8 neighbours of a cell are numbered in row-major order around it:
///
///     5 6 7   row + 1 (the next higher laser)
///     3 . 4
///     0 1 2   row - 1
///
/// Columns are cyclic, rows are not.
inline constexpr int kDirections = 8;

struct CellStep {
  int rows, columns;
};
inline constexpr std::array<CellStep, kDirections> kCellSteps{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

/// Returns the direction from the neighbour back to the cell.
[[nodiscard]] constexpr int opposite(int direction) noexcept {
  return kDirections - 1 - direction;
}

/// Indices (row * stride + column) of the 8 neighbours, by direction.
using NeighbourCells = std::array<std::uint32_t, kDirections>;

/// Returns the neighbours of the cell in `row` [0, rows) and `column` [0, columns). A direction
/// that leads outside the rows gives the cell itself, so that every entry may be read.
[[nodiscard]] constexpr NeighbourCells neighbour_cells(const frame::ImageShape& shape, int row,
                                                       int column) noexcept {
  const auto at = [stride = shape.stride()](int r, int c) {
    return static_cast<std::uint32_t>(r * stride + c);
  };
  const int left = column == 0 ? shape.columns - 1 : column - 1;
  const int right = column + 1 == shape.columns ? 0 : column + 1;
  NeighbourCells cells{at(row - 1, left),   at(row - 1, column), at(row - 1, right),
                       at(row, left),       at(row, right),      at(row + 1, left),
                       at(row + 1, column), at(row + 1, right)};
  if (row == 0) cells[0] = cells[1] = cells[2] = at(row, column);
  if (row + 1 == shape.rows) cells[5] = cells[6] = cells[7] = at(row, column);
  return cells;
}

/// Returns the same as neighbour_cells(), but faster, for a cell that is not at an edge of the
/// image.
[[nodiscard]] constexpr NeighbourCells neighbours_inside(std::uint32_t cell,
                                                         std::uint32_t stride) noexcept {
  const std::uint32_t below = cell - stride, above = cell + stride;
  return {below - 1, below, below + 1, cell - 1, cell + 1, above - 1, above, above + 1};
}

/// True if the neighbours are contiguous in memory, as those of a cell that is not at an edge of
/// the image: four cells may then be read from neighbours[0], [3] and [5] - 1 on.
[[nodiscard]] constexpr bool are_next_to_each_other(const NeighbourCells& neighbours) noexcept {
  return neighbours[0] + 2 == neighbours[2] && neighbours[3] + 2 == neighbours[4] &&
         neighbours[5] + 2 == neighbours[7];
}

}  // namespace terracut::min_cut
