// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include "firmware_io/frame/cell_owner.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// Keeps the returns of a frame as its sensor measured them, in tiles of firings: distances,
/// intensities, head azimuths, and for each return whether it owns its cell of the range image.
/// Takes a third of the memory of points, and is written in one stream; PointRing and
/// PointImage compute points from it where they are needed.
///
/// Returns are numbered in order of arrival: by firing, then by laser. Fixed memory; only the
/// constructor allocates. One writer until the frame is handed over, then readers only.
class MeasuredReturns {
 public:
  /// The returns of one laser in a tile; masks have one bit per firing.
  struct LaserRow {
    std::int32_t least = 0, most = -1;  ///< No return is in a column outside [least, most].
    std::uint32_t returns = 0;          ///< Mask of the returns of this frame.
    std::uint32_t owned = 0;            ///< Mask of the returns that own their cells.
    /// True if firing f is in column least + f, and no earlier return is in any of these columns.
    bool is_run = false;
  };
  struct Tile {
    TileHeads heads;                      ///< Azimuths, counted from the start of this frame.
    TileRow<std::uint32_t> first_return;  ///< The number of each firing's first return.
    std::int32_t least = 0, most = -1;    ///< The least and the greatest column over all lasers.
    std::int64_t first_ns = 0,
                 last_ns = 0;  ///< Stamps of the packets of its first and last firing.
  };
  /// A tile to be added.
  struct NewTile {
    TileHeads heads;  ///< Azimuths, counted from the start of this frame.
    TileDistances distances;
    const std::uint8_t* intensity;
    /// Columns of the beams, indexed by laser; this frame's columns begin at `first_column`.
    std::span<const BeamColumns> beams;
    std::int32_t first_column;
    std::int64_t first_ns = 0,
                 last_ns = 0;  ///< Stamps of the packets of its first and last firing.
  };

  static constexpr std::size_t kMostLasers = 256;

  /// Takes memory for `tiles` tiles of `lasers` lasers each, a multiple of 8 and at most
  /// kMostLasers. Several lasers may share a row. `has_fine` says whether tiles have fine
  /// distances.
  MeasuredReturns(ImageShape shape, std::size_t lasers, std::size_t tiles,
                  memory::FixedMemory& memory, bool has_fine = false);

  /// Removes all returns; those to come are of this turn.
  void clear(std::int64_t turn) noexcept TERRACUT_NONBLOCKING;

  /// Adds the part of a tile that belongs to this frame. If several returns fall into a cell,
  /// `owner` says which of them owns it (the earlier if equal). `reader` is the sensor's; any tile
  /// open in it is closed. Returns the number of returns for which there was no room. Real-time
  /// safe; a return whose cell is taken costs more than others, at worst a search of all tiles.
  [[nodiscard]] std::uint32_t add(const NewTile& tile, CellOwner owner,
                                  TileReader& reader) noexcept TERRACUT_NONBLOCKING;

  /// Returns the number of the turn. Turns follow each other without a gap exactly if their numbers
  /// do; no two have the same.
  [[nodiscard]] std::int64_t turn() const noexcept { return turn_; }
  [[nodiscard]] std::size_t tiles() const noexcept { return used_; }
  [[nodiscard]] const Tile& tile(std::size_t number) const noexcept { return tiles_[number]; }
  /// Returns the number of the first return after those of a tile.
  [[nodiscard]] std::uint32_t end_of(std::size_t tile) const noexcept {
    return tile + 1 < used_ ? tiles_[tile + 1].first_return[0] : returns_;
  }
  [[nodiscard]] const LaserRow& row(std::size_t tile, std::size_t laser) const noexcept {
    return rows_[tile * lasers_ + laser];
  }
  [[nodiscard]] const std::uint16_t* raw(std::size_t tile) const noexcept {
    return &raw_[tile * lasers_ * kTileFirings];
  }
  [[nodiscard]] TileDistances distances(std::size_t tile) const noexcept {
    const std::uint8_t* const fine =
        fine_.empty() ? nullptr : &fine_[tile * lasers_ * kTileFirings];
    return {raw(tile), fine};
  }
  /// Returns the intensities of a laser's firings.
  [[nodiscard]] const std::uint8_t* intensity(std::size_t tile, std::size_t laser) const noexcept {
    return &intensity_[(tile * lasers_ + laser) * kTileFirings];
  }
  /// Returns the column of a return.
  [[nodiscard]] int column(std::size_t tile, std::size_t laser, std::size_t firing) const noexcept {
    const std::size_t row = tile * lasers_ + laser;
    return rows_[row].is_run ? rows_[row].least + static_cast<int>(firing)
                             : int{columns_[row * kTileFirings + firing]};
  }
  /// Returns the columns of all firings of a row; meaningful only where there are returns.
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
  static constexpr std::size_t kNoTile = std::numeric_limits<std::size_t>::max();

  struct Place {
    std::size_t tile, laser, firing;
  };

  void number_returns(const NewTile& tile, Tile& added, std::span<const LaserRow> rows) noexcept;
  void take_cells(const NewTile& tile, std::size_t laser, std::uint32_t hits, int row,
                  CellOwner owner, TileReader& reader) noexcept;
  /// Of the returns `left` of a laser, handles those whose cell belongs to the previous firing, the
  /// other return of the same beam: decides the owner of such a cell. Returns the mask of these
  /// firings.
  [[nodiscard]] std::uint32_t take_pairs(std::size_t laser, std::uint32_t left, CellOwner owner,
                                         TileReader& reader) noexcept;
  /// Places a return in a cell that may be taken already.
  void take_cell(const Place& at, int row, int column, CellOwner owner,
                 TileReader& reader) noexcept;
  /// Prefetches the next tile's memory: three frames do not fit the caches next to a core.
  void fetch_next() const noexcept;
  /// Returns the return that owns a cell, considering those up to `newest`; the cell must have an
  /// owner.
  [[nodiscard]] Place owner_before(const Place& newest, int row, int column,
                                   TileReader& reader) const noexcept;
  [[nodiscard]] bool goes_before(const Place& newer, const Place& older, CellOwner owner,
                                 TileReader& reader) noexcept;
  /// Returns the horizontal distances of the returns of a laser.
  [[nodiscard]] TileRow<float> ground_ranges_m(std::size_t tile, std::size_t laser,
                                               TileReader& reader) noexcept;
  [[nodiscard]] std::span<std::uint64_t> bits_of(std::span<std::uint64_t> cells,
                                                 int row) const noexcept {
    return cells.subspan(static_cast<std::size_t>(row) * words_, words_);
  }
  [[nodiscard]] LaserRow& row_at(std::size_t tile, std::size_t laser) noexcept {
    return rows_[tile * lasers_ + laser];
  }

  ImageShape shape_;
  std::size_t lasers_, words_;
  std::int64_t turn_ = 0;
  std::size_t used_ = 0;
  std::size_t open_ = kNoTile;  ///< The tile that is open in the reader of add().
  std::uint32_t returns_ = 0;
  std::span<Tile> tiles_;
  std::span<LaserRow> rows_;      ///< Indexed [tile][laser].
  std::span<std::uint16_t> raw_;  ///< Indexed [tile][laser][firing].
  std::span<std::uint8_t> fine_;  ///< The same; empty if there are no fine distances.
  /// Indexed [tile][laser][firing]; set only for rows with is_run false.
  std::span<std::uint16_t> columns_;
  std::span<std::uint8_t> intensity_;
  // For each row, one bit per column.
  std::span<std::uint64_t> taken_;
};

}  // namespace terracut::frame
