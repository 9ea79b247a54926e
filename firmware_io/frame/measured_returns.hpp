// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware_io/frame/cell_owner.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// The returns of a frame as its sensor measured them, in tiles of firings: distances, intensities
/// and where the head was, and of each return whether it owns its cell of the range image. Takes a
/// third of the memory of points, is written in one stream, and points are made of it where and
/// when they are needed (PointWindow, ScatteredPoints).
///
/// Returns are numbered in order of arrival: firing, laser. Fixed memory; nothing here but the
/// constructor allocates. One writer until the frame is handed over, then readers only.
class MeasuredReturns {
 public:
  /// What one laser found in a tile; bits by firing.
  struct LaserRow {
    std::int32_t least = 0, most = -1;  ///< No return is in a column outside [least, most].
    std::uint32_t returns = 0;          ///< Those of this frame.
    std::uint32_t owned = 0;            ///< Of these, the ones that own their cells.
    /// Firing f is in column least + f, and no earlier return is in any of these columns.
    bool is_run = false;
  };
  struct Tile {
    TileHeads heads;                      ///< From the beginning of this frame.
    TileRow<std::uint32_t> first_return;  ///< The number of each firing's first return.
    std::int32_t least = 0, most = -1;    ///< Of all lasers.
  };
  /// A tile that is to be added.
  struct NewTile {
    TileHeads heads;           ///< From the beginning of this frame.
    const std::uint16_t* raw;  ///< Laser by laser, kTileFirings each; 0: no return.
    const std::uint8_t* intensity;
    /// By laser; those of this frame begin at `first_column`.
    std::span<const BeamColumns> beams;
    std::int32_t first_column;
  };

  static constexpr std::size_t kMostLasers = 256;

  /// Room for `tiles` of `lasers`, kMostLasers at most, a multiple of 8. Several may be of one row.
  MeasuredReturns(ImageShape shape, std::size_t lasers, std::size_t tiles,
                  memory::FixedMemory& memory);

  void clear() noexcept TERRACUT_NONBLOCKING;

  /// Takes what is this frame's of a tile. Where several returns are in one cell, `owner` says
  /// which has it (the earlier one when they are equal). `reader`: of the sensor; the tile that was
  /// open in it is not any more. Returns how many returns found no room and are not kept. Real-time
  /// safe; a return that finds its cell taken costs more than others, up to a look at all tiles.
  [[nodiscard]] std::uint32_t add(const NewTile& tile, CellOwner owner,
                                  TileReader& reader) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] std::size_t tiles() const noexcept { return used_; }
  [[nodiscard]] const Tile& tile(std::size_t number) const noexcept { return tiles_[number]; }
  [[nodiscard]] const LaserRow& row(std::size_t tile, std::size_t laser) const noexcept {
    return rows_[tile * lasers_ + laser];
  }
  [[nodiscard]] const std::uint16_t* raw(std::size_t tile) const noexcept {
    return &raw_[tile * lasers_ * kTileFirings];
  }
  /// Whether several returns are in one of these cells.
  [[nodiscard]] bool has_shared(int row, ColumnRange columns) const noexcept TERRACUT_NONBLOCKING;
  /// Of a return.
  [[nodiscard]] int column(std::size_t tile, std::size_t laser, std::size_t firing) const noexcept {
    const std::size_t row = tile * lasers_ + laser;
    return rows_[row].is_run ? rows_[row].least + static_cast<int>(firing)
                             : int{columns_[row * kTileFirings + firing]};
  }
  /// Of all firings of a row, where they are returns.
  [[nodiscard]] TileRow<std::uint16_t> columns(std::size_t tile, std::size_t laser) const noexcept {
    const std::size_t row = tile * lasers_ + laser;
    TileRow<std::uint16_t> columns;
    if (!rows_[row].is_run) {
      std::memcpy(columns.data(), &columns_[row * kTileFirings], sizeof(columns));
      return columns;
    }
    const auto least = static_cast<std::uint16_t>(rows_[row].least);
    for (std::size_t f = 0; f < kTileFirings; ++f) {
      columns[f] = static_cast<std::uint16_t>(least + f);
    }
    return columns;
  }
  [[nodiscard]] std::size_t lasers() const noexcept { return lasers_; }
  [[nodiscard]] const ImageShape& shape() const noexcept { return shape_; }
  [[nodiscard]] std::uint32_t returns() const noexcept { return returns_; }
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return tiles_.size() * lasers_ * kTileFirings;
  }

 private:
  struct Place {
    std::size_t tile, laser, firing;
  };

  void number_returns(const NewTile& tile, Tile& added, std::span<const LaserRow> rows) noexcept;
  void take_cells(const NewTile& tile, std::size_t laser, std::uint32_t hits, int row,
                  CellOwner owner, TileReader& reader) noexcept;
  /// Of those `left` of a laser's returns whose cells are taken: those whose cells belong to the
  /// firing just before, the other return of a beam. Says which of the two has each cell where that
  /// is known without their points; returns those that it settled.
  [[nodiscard]] std::uint32_t take_pairs(std::size_t laser, int row, std::uint32_t left,
                                         CellOwner owner) noexcept;
  /// Of a return whose cell may be taken.
  void take_cell(const Place& at, int row, int column, CellOwner owner,
                 TileReader& reader) noexcept;
  /// Asks for the memory of the next tile: three frames do not fit the caches next to a core.
  void fetch_next() const noexcept;
  /// The return that owns a cell, of those taken up to `newest`; there is one.
  [[nodiscard]] Place owner_before(const Place& newest, int row, int column,
                                   TileReader& reader) const noexcept;
  [[nodiscard]] bool goes_before(const Place& newer, const Place& older, CellOwner owner,
                                 TileReader& reader) const noexcept;
  [[nodiscard]] float ground_range_m(const Place& at, TileReader& reader) const noexcept;
  [[nodiscard]] std::span<std::uint64_t> bits_of(std::span<std::uint64_t> cells,
                                                 int row) const noexcept {
    return cells.subspan(static_cast<std::size_t>(row) * words_, words_);
  }
  [[nodiscard]] LaserRow& row_at(std::size_t tile, std::size_t laser) noexcept {
    return rows_[tile * lasers_ + laser];
  }

  ImageShape shape_;
  std::size_t lasers_, words_;
  std::size_t used_ = 0;
  std::uint32_t returns_ = 0;
  std::span<Tile> tiles_;
  std::span<LaserRow> rows_;          ///< [tile][laser]
  std::span<std::uint16_t> raw_;      ///< [tile][laser][firing]
  std::span<std::uint16_t> columns_;  ///< Likewise; of rows that are no run.
  std::span<std::uint8_t> intensity_;
  // By row, a bit for each column.
  std::span<std::uint64_t> taken_, shared_;
};

}  // namespace terracut::frame
