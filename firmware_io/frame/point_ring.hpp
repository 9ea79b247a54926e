// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// The points of a sensor's last turn, in planes of an image whose columns are used again and
/// again: the columns of a turn replace those of the turn before it, as they come.
///
///   columns   0 ............................................ all
///             |  this turn's  | empty |  the turn before  |
///
/// A cell without a return has a NaN height; its other planes hold old values. Takes its memory in
/// the constructor. One thread; real-time safe.
class PointRing {
 public:
  /// `reader` is made by the sensor's decoder.
  PointRing(ImageShape shape, std::unique_ptr<TileReader> reader, memory::FixedMemory& memory);

  /// Begins a turn; no column of it is there yet.
  void begin_turn() noexcept TERRACUT_NONBLOCKING { next_tile_ = begun_ = 0; }
  /// Computes the points of a turn's returns that have arrived in columns before `end`, and empties
  /// these columns where there is none. Call it from left to right. Calls `take_extra(column, z_m,
  /// ground_range_m)` once for each return that does not own its cell.
  template <class TakeExtra>
  void make_until(int end, const MeasuredReturns& turn, TakeExtra take_extra) noexcept;

  [[nodiscard]] PointPlanes planes() const noexcept {
    return {x_m_.data(), y_m_.data(), z_m_.data(), ground_range_m_.data()};
  }
  /// Lends the reader for reading tiles on the same thread.
  [[nodiscard]] TileReader& reader() noexcept { return *reader_; }

 private:
  /// Empties the columns of the turn before `end` that no tile has reached yet.
  void empty_until(int end) noexcept TERRACUT_NONBLOCKING;
  /// Computes the points of a laser in the open tile; `take_extra` is as in make_until().
  template <class TakeExtra>
  void make_row(const MeasuredReturns& turn, std::size_t tile, std::size_t laser,
                TakeExtra take_extra) noexcept;
  /// Prefetches about one and a half cache lines of each plane.
  void fetch_to_write(std::size_t cell) const noexcept TERRACUT_NONBLOCKING;

  ImageShape shape_;
  std::unique_ptr<TileReader> reader_;
  std::span<float> x_m_, y_m_, z_m_, ground_range_m_;
  std::size_t next_tile_ = 0;  // the first tile of the turn whose points are not computed yet
  int begun_ = 0;              // columns before this one belong to the turn
  TilePoints points_;
};

template <class TakeExtra>
void PointRing::make_until(int end, const MeasuredReturns& turn, TakeExtra take_extra) noexcept {
  // Tiles come from left to right, except late ones: some of their points are computed before `end`
  // reaches them, which does no harm.
  for (; next_tile_ < turn.tiles() && turn.tile(next_tile_).least < end; ++next_tile_) {
    empty_until(turn.tile(next_tile_).most + 1);
    reader_->open(turn.tile(next_tile_).heads, turn.distances(next_tile_));
    for (std::size_t i = 0; i < turn.lasers(); ++i) {
      if (turn.row(next_tile_, i).returns != 0) make_row(turn, next_tile_, i, take_extra);
    }
  }
  empty_until(end);
}

template <class TakeExtra>
void PointRing::make_row(const MeasuredReturns& turn, std::size_t tile, std::size_t laser,
                         TakeExtra take_extra) noexcept {
  const MeasuredReturns::LaserRow& row = turn.row(tile, laser);
  const std::size_t first = shape_.cell(reader_->rows()[laser], 0);
  fetch_to_write(first + static_cast<std::size_t>(row.most) + 1);  // for the next tile
  if (row.is_run && row.owned == row.returns) {
    const std::size_t cell = first + static_cast<std::size_t>(row.least);
    reader_->compute_points(laser, {&x_m_[cell], &y_m_[cell], &z_m_[cell], &ground_range_m_[cell]});
    return;
  }
  reader_->compute_points(laser, all_of(points_));
  const TileRow<std::uint16_t> columns = turn.columns(tile, laser);
  for_each_firing(row.returns & ~row.owned, [&](std::size_t f) noexcept {
    take_extra(int{columns[f]}, points_.z_m[f], points_.ground_range_m[f]);
  });
  for_each_firing(row.owned, [&](std::size_t f) noexcept {
    const int column = columns[f];
    const std::size_t cell = first + static_cast<std::size_t>(column);
    // An earlier return owned this cell, and its point is in the planes: it becomes an extra.
    if (z_m_[cell] == z_m_[cell]) take_extra(column, z_m_[cell], ground_range_m_[cell]);
    x_m_[cell] = points_.x_m[f];
    y_m_[cell] = points_.y_m[f];
    z_m_[cell] = points_.z_m[f];
    ground_range_m_[cell] = points_.ground_range_m[f];
  });
}

}  // namespace terracut::frame
