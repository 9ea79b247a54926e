// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/image_shape.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Finds the parts of the image in which cells are unknown or next to an unknown cell: there a
/// cut's graph has nodes and edges. Works by groups of columns, so it also reports some cells
/// farther away.
///
/// Takes all memory in the constructor. One thread; real-time safe.
class NearUnknown {
 public:
  NearUnknown(frame::ImageShape shape, memory::FixedMemory& memory);

  /// Reads all seeds of a frame, including those of padding cells.
  void find(std::span<const Seed> seeds) noexcept TERRACUT_NONBLOCKING;
  /// True if one of these cells, or a neighbour of one, is unknown.
  [[nodiscard]] bool is_near(int row, frame::ColumnRange columns) const noexcept {
    const std::size_t row_begin = static_cast<std::size_t>(row) * groups_;
    const int left = columns.begin == 0 ? columns_ - 1 : columns.begin - 1;
    const int right = columns.end == columns_ ? 0 : columns.end;
    std::uint8_t found = static_cast<std::uint8_t>(near_[row_begin + group_of(left)] |
                                                   near_[row_begin + group_of(right)]);
    for (std::size_t group = group_of(columns.begin); group <= group_of(columns.end - 1); ++group) {
      found = static_cast<std::uint8_t>(found | near_[row_begin + group]);
    }
    return found != 0;
  }

 private:
  static constexpr std::size_t kColumnsAGroup = 16;  // divides every row's stride

  [[nodiscard]] static std::size_t group_of(int column) noexcept {
    return static_cast<std::size_t>(column) / kColumnsAGroup;
  }

  int columns_;
  std::size_t rows_, groups_;
  std::span<std::uint8_t> unknown_;  // [row][group]: the group has an unknown cell
  // [row][group]: this row or an adjacent one has an unknown cell in or next to the group
  std::span<std::uint8_t> near_;
};

}  // namespace terracut::min_cut
