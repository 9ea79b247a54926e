// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/frame_points.hpp"

#include <algorithm>

namespace terracut::frame {

FramePoints::FramePoints(ImageShape shape, std::unique_ptr<TileReader> reader,
                         memory::FixedMemory& memory)
    : shape_(shape),
      reader_(std::move(reader)),
      x_m_(memory.take<float>("points of a frame", shape.cells())),
      y_m_(memory.take<float>("points of a frame", shape.cells())),
      z_m_(memory.take<float>("points of a frame", shape.cells())),
      ground_range_m_(memory.take<float>("points of a frame", shape.cells())) {}

void FramePoints::begin(const RangeImage& image) noexcept {
  image_ = &image;
  generation_ = image.generation();
  next_ = 0;
  std::fill(z_m_.begin(), z_m_.end(), kNoHeight_m);
}

void FramePoints::make_until(int end, const RangeImage& image) noexcept {
  const MeasuredReturns& returns = *image.measured();
  // Tiles come from left to right, but for late ones, which are made a little too soon.
  for (; next_ < returns.tiles() && returns.tile(next_).least < end; ++next_) {
    reader_->open(returns.tile(next_).heads, returns.raw(next_));
    for (std::size_t i = 0; i < returns.lasers(); ++i) {
      if (returns.row(next_, i).owned != 0) make_row(returns, next_, i);
    }
  }
}

void FramePoints::fetch_to_write(std::size_t cell) const noexcept {
  constexpr std::size_t kLineCells = 16;
  for (const std::span<float> plane : {x_m_, y_m_, z_m_, ground_range_m_}) {
    if (cell + kLineCells >= plane.size()) return;
    __builtin_prefetch(&plane[cell], 1, 2);
    __builtin_prefetch(&plane[cell + kLineCells], 1, 2);
  }
}

void FramePoints::make_row(const MeasuredReturns& returns, std::size_t tile,
                           std::size_t laser) noexcept {
  const MeasuredReturns::LaserRow& row = returns.row(tile, laser);
  const std::size_t first = shape_.cell(reader_->rows()[laser], 0);
  fetch_to_write(first + static_cast<std::size_t>(row.most) + 1);  // the next tile's
  if (row.is_run && row.owned == row.returns) {
    const std::size_t cell = first + static_cast<std::size_t>(row.least);
    reader_->compute_points(laser, {&x_m_[cell], &y_m_[cell], &z_m_[cell], &ground_range_m_[cell]});
    return;
  }
  reader_->compute_points(laser, all_of(points_));
  for_each_firing(row.owned, [&](std::size_t f) noexcept {
    const std::size_t cell = first + static_cast<std::size_t>(returns.column(tile, laser, f));
    x_m_[cell] = points_.x_m[f];
    y_m_[cell] = points_.y_m[f];
    z_m_[cell] = points_.z_m[f];
    ground_range_m_[cell] = points_.ground_range_m[f];
  });
}

}  // namespace terracut::frame
