// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
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

/// Computes the points of decoded frames only where they are needed, into planes of a whole image,
/// one frame after the other. Whoever needs all points, with their intensities and numbers, uses
/// PointImage.
///
/// Takes its memory in the constructor. One thread; real-time safe.
class FramePoints {
 public:
  /// `reader` is made by the sensor's decoder.
  FramePoints(ImageShape shape, std::unique_ptr<TileReader> reader, memory::FixedMemory& memory);

  /// Begins a frame, or begins it again, with no points computed.
  void begin(const MeasuredReturns& returns) noexcept TERRACUT_NONBLOCKING;
  /// Computes the points of returns that have arrived in columns before `end`. Call it from left to
  /// right after begin(). A cell without a return gets a NaN height. Calls `take_extra(column, z_m,
  /// ground_range_m)` once for each of these returns that does not own its cell.
  template <class TakeExtra>
  void make_until(int end, const MeasuredReturns& returns, TakeExtra take_extra) noexcept;
  /// True if all points of the frame are computed.
  [[nodiscard]] bool has_all_of(const MeasuredReturns& returns) const noexcept {
    return has_begun(returns) && next_ == returns.tiles();
  }
  /// Computes the points of all cells for which `is_wanted(row, ColumnRange)`, unless all of the
  /// frame's are computed. Other cells, and cells without a return, hold arbitrary values. Ends the
  /// frame that begin() began.
  template <class IsWanted>
  void make_where(const MeasuredReturns& returns, IsWanted is_wanted) noexcept;
  [[nodiscard]] PointPlanes planes() const noexcept {
    return {x_m_.data(), y_m_.data(), z_m_.data(), ground_range_m_.data()};
  }

  /// Lends the reader for reading tiles on the same thread.
  [[nodiscard]] TileReader& reader() noexcept { return *reader_; }

 private:
  [[nodiscard]] bool has_begun(const MeasuredReturns& returns) const noexcept {
    return begun_ == &returns && generation_ == returns.generation();
  }
  /// Computes the points of a laser in the open tile; `take_extra` is as in make_until().
  template <class TakeExtra>
  void make_row(const MeasuredReturns& returns, std::size_t tile, std::size_t laser,
                TakeExtra take_extra) noexcept;
  /// Prefetches about one and a half cache lines of each plane.
  void fetch_to_write(std::size_t cell) const noexcept TERRACUT_NONBLOCKING;

  ImageShape shape_;
  std::unique_ptr<TileReader> reader_;
  std::span<float> x_m_, y_m_, z_m_, ground_range_m_;
  const MeasuredReturns* begun_ = nullptr;  ///< The frame begun by begin().
  std::uint32_t generation_ = 0;
  std::size_t next_ = 0;  ///< The first tile whose points are not computed yet.
  TilePoints points_;
};

template <class TakeExtra>
void FramePoints::make_until(int end, const MeasuredReturns& returns,
                             TakeExtra take_extra) noexcept {
  // Tiles come from left to right, except late ones: some of their points are computed before `end`
  // reaches them, which does no harm.
  for (; next_ < returns.tiles() && returns.tile(next_).least < end; ++next_) {
    reader_->open(returns.tile(next_).heads, returns.raw(next_));
    for (std::size_t i = 0; i < returns.lasers(); ++i) {
      if (returns.row(next_, i).returns != 0) make_row(returns, next_, i, take_extra);
    }
  }
}

template <class IsWanted>
void FramePoints::make_where(const MeasuredReturns& returns, IsWanted is_wanted) noexcept {
  if (has_all_of(returns)) return;
  begun_ = nullptr;
  const std::span<const std::int32_t> rows = reader_->rows();
  for (std::size_t t = 0; t < returns.tiles(); ++t) {
    bool is_open = false;
    for (std::size_t i = 0; i < returns.lasers(); ++i) {
      const MeasuredReturns::LaserRow& row = returns.row(t, i);
      if (row.owned == 0 || !is_wanted(rows[i], ColumnRange{row.least, row.most + 1})) continue;
      if (!std::exchange(is_open, true)) reader_->open(returns.tile(t).heads, returns.raw(t));
      make_row(returns, t, i, [](int, float, float) noexcept {});
    }
  }
}

template <class TakeExtra>
void FramePoints::make_row(const MeasuredReturns& returns, std::size_t tile, std::size_t laser,
                           TakeExtra take_extra) noexcept {
  const MeasuredReturns::LaserRow& row = returns.row(tile, laser);
  const std::size_t first = shape_.cell(reader_->rows()[laser], 0);
  fetch_to_write(first + static_cast<std::size_t>(row.most) + 1);  // for the next tile
  if (row.is_run && row.owned == row.returns) {
    const std::size_t cell = first + static_cast<std::size_t>(row.least);
    reader_->compute_points(laser, {&x_m_[cell], &y_m_[cell], &z_m_[cell], &ground_range_m_[cell]});
    return;
  }
  reader_->compute_points(laser, all_of(points_));
  const TileRow<std::uint16_t> columns = returns.columns(tile, laser);
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
