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

void FramePoints::begin(const MeasuredReturns& returns) noexcept {
  begun_ = &returns;
  generation_ = returns.generation();
  next_ = 0;
  std::fill(z_m_.begin(), z_m_.end(), kNoHeight_m);
}

void FramePoints::fetch_to_write(std::size_t cell) const noexcept {
  constexpr std::size_t kLineCells = 16;
  for (const std::span<float> plane : {x_m_, y_m_, z_m_, ground_range_m_}) {
    if (cell + kLineCells >= plane.size()) return;
    __builtin_prefetch(&plane[cell], 1, 2);
    __builtin_prefetch(&plane[cell + kLineCells], 1, 2);
  }
}

}  // namespace terracut::frame
