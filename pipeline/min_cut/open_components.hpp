// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/image_shape.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Finds the connected components of unknown cells while the columns of an endless circle come one
/// after the other, and tells which are closed: no cell that is still to come can join them. As
/// seeds cut the graph, the minimum cut of a closed component is its part of the minimum cut of all
/// columns.
///
///   columns taken            | to come
///   . A A . . . B B B B B B  |            A is closed, B is open
///   . . A . . . . B . . . .  |
///
/// Cells taken become Seed::kWaiting; those of closed components become kUnknown again, to be cut.
/// A component that stays open for more than an eighth of the circle is released as it is.
///
/// All memory is taken in the constructor. One thread; real-time safe.
class OpenComponents {
 public:
  /// At most `capacity` cells can wait at a time; two columns or more must fit.
  OpenComponents(const frame::ImageShape& shape, std::size_t capacity, memory::FixedMemory& memory);

  /// What became unknown again.
  struct Released {
    ColumnWindow window;           ///< Holds these cells.
    std::uint32_t cells = 0;       ///< Number of these cells.
    std::uint32_t cells_open = 0;  ///< Number of these cells in components that were still open.
  };

  /// Begins at this column; nothing waits, and nothing before the column can join a component.
  void begin(int column) noexcept TERRACUT_NONBLOCKING;
  /// Returns a number of columns for which there is room if half the capacity is free.
  [[nodiscard]] int most_at_once() const noexcept {
    return std::max(static_cast<int>(cells_.size()) / 2 / shape_.rows, 1);
  }
  /// True if there is room for all cells of `count` more columns.
  [[nodiscard]] bool has_room(int count) const noexcept {
    return static_cast<std::size_t>(count) * static_cast<std::size_t>(shape_.rows) <= free_count_;
  }
  /// Takes the unknown cells of the next `count` columns, for which there must be room.
  Released take(int count, std::span<Seed> seeds) noexcept TERRACUT_NONBLOCKING;
  /// Releases all components, closed or not.
  Released release_all(std::span<Seed> seeds) noexcept TERRACUT_NONBLOCKING;

  /// Returns how many of the columns taken last hold the cells that wait; 0 if none waits.
  [[nodiscard]] int waiting_columns() const noexcept { return waiting_columns_; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// A waiting cell. The cells of a component form a ring by `next` and a tree by `parent`.
  struct Cell {
    std::uint32_t cell, parent, next;
    // Of the component, counted on without end, modulo 2^32; valid at the tree's root.
    std::uint32_t first_column, last_column;
  };

  void take_piece(frame::ColumnRange columns, std::span<Seed> seeds) noexcept;
  /// Makes the cells of closed components unknown, and of others that began `most_columns` ago.
  Released release(std::uint32_t most_columns, std::span<Seed> seeds) noexcept;
  [[nodiscard]] std::uint32_t root_of(std::uint32_t id) noexcept;
  void join(std::uint32_t a, std::uint32_t b) noexcept;
  /// Joins a cell with those of a column beside it, in the same row, the one below and the one
  /// above.
  void join_beside(std::uint32_t id, std::span<const std::uint32_t> column, int row) noexcept;

  frame::ImageShape shape_;
  int column_ = 0;           // of the image, the next to take
  std::uint32_t taken_ = 0;  // number of columns taken so far, modulo 2^32
  int waiting_columns_ = 0;
  std::span<Cell> cells_;
  std::span<std::uint32_t> free_;   // numbers of unused cells, in the first free_count_
  std::span<std::uint32_t> roots_;  // of open components, in the first open_
  std::uint32_t free_count_ = 0, open_ = 0;
  std::span<std::uint32_t> here_, below_;  // by column of a piece, in a row and in the row below
  // By row: the cell waiting in the last column taken before a piece, and in the last one of a
  // piece; kNone if there is none.
  std::span<std::uint32_t> last_, next_last_;
};

}  // namespace terracut::min_cut
