// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/point_ring.hpp"

#include <algorithm>

namespace terracut::frame {

PointRing::PointRing(ImageShape shape, std::unique_ptr<TileReader> reader,
                     memory::FixedMemory& memory)
    : shape_(shape),
      reader_(std::move(reader)),
      x_m_(memory.take<float>("points of a turn", shape.cells())),
      y_m_(memory.take<float>("points of a turn", shape.cells())),
      z_m_(memory.take<float>("points of a turn", shape.cells())),
      ground_range_m_(memory.take<float>("points of a turn", shape.cells())) {
  std::ranges::fill(z_m_, kNoHeight_m);
}

void PointRing::empty_until(int end) noexcept {
  if (end <= begun_) return;
  for (int row = 0; row < shape_.rows; ++row) {
    std::fill(&z_m_[shape_.cell(row, begun_)], &z_m_[shape_.cell(row, end - 1)] + 1, kNoHeight_m);
  }
  begun_ = end;
}

void PointRing::fetch_to_write(std::size_t cell) const noexcept {
  constexpr std::size_t kLineCells = 16;
  for (const std::span<float> plane : {x_m_, y_m_, z_m_, ground_range_m_}) {
    if (cell + kLineCells >= plane.size()) return;
    __builtin_prefetch(&plane[cell], 1, 2);
    __builtin_prefetch(&plane[cell + kLineCells], 1, 2);
  }
}

}  // namespace terracut::frame
