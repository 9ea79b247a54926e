// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/range_image.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::frame {

RangeImage::RangeImage(ImageShape shape, std::size_t overflow_capacity, memory::FixedMemory& memory)
    : shape_(shape),
      stride_(shape.stride()),
      x_m_(memory.take<float>("range images", shape.cells())),
      y_m_(memory.take<float>("range images", shape.cells())),
      z_m_(memory.take<float>("range images", shape.cells())),
      ground_range_m_(memory.take<float>("range images", shape.cells())),
      intensity_(memory.take<std::uint8_t>("range images", shape.cells())),
      return_index_(memory.take<std::uint32_t>("range images", shape.cells())),
      overflow_(memory.take<OverflowReturn>("range images", overflow_capacity)),
      empty_from_(memory.take<std::int32_t>("range images", static_cast<std::size_t>(shape.rows))) {
  const auto plane = [](const auto& cells) {
    return Plane{reinterpret_cast<const std::byte*>(cells.data()), sizeof(cells[0])};
  };
  planes_ = {plane(x_m_),       plane(y_m_),         plane(z_m_), plane(ground_range_m_),
             plane(intensity_), plane(return_index_)};
  std::ranges::fill(z_m_, kNoHeight_m);
}

RangeImage::RangeImage(ImageShape shape, MeasuredReturns measured) noexcept
    : shape_(shape), stride_(shape.stride()), measured_(measured) {}

void RangeImage::clear() noexcept {
  ++generation_;
  if (measured_) return measured_->clear();
  returns_ = 0;
  overflow_used_ = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    std::int32_t& empty_from = empty_from_[static_cast<std::size_t>(row)];
    std::ranges::fill(
        z_m_.subspan(shape_.cell(row, 0), static_cast<std::size_t>(std::exchange(empty_from, 0))),
        kNoHeight_m);
  }
}

void RangeImage::move(std::span<const PlanarMotions> by_row) noexcept {
  const auto columns = static_cast<std::size_t>(shape_.columns);
  const auto stride = static_cast<std::size_t>(stride_);
  for (std::size_t row = 0; row < by_row.size(); ++row) {
    // Cells without a return are moved as well: skipping them would cost more.
    float* const __restrict x_m = x_m_.subspan(row * stride, columns).data();
    float* const __restrict y_m = y_m_.subspan(row * stride, columns).data();
    float* const __restrict ground_range_m = ground_range_m_.subspan(row * stride, columns).data();
    const PlanarMotions& motion = by_row[row];
    for (std::size_t i = 0; i < columns; ++i) {
      const float x = motion.cosine[i] * x_m[i] - motion.sine[i] * y_m[i] + motion.x_m[i];
      const float y = motion.sine[i] * x_m[i] + motion.cosine[i] * y_m[i] + motion.y_m[i];
      x_m[i] = x;
      y_m[i] = y;
      ground_range_m[i] = std::sqrt(x * x + y * y);
    }
  }
  for (OverflowReturn& extra : overflow_.first(overflow_used_)) {
    const PlanarMotions& motion = by_row[extra.cell / stride];
    const std::size_t i = extra.cell % stride;
    Return& point = extra.point;
    const float x = motion.cosine[i] * point.x_m - motion.sine[i] * point.y_m + motion.x_m[i];
    const float y = motion.sine[i] * point.x_m + motion.cosine[i] * point.y_m + motion.y_m[i];
    point.x_m = x;
    point.y_m = y;
    point.ground_range_m = std::sqrt(x * x + y * y);
  }
}

bool RangeImage::owns(std::size_t cell, const Return& point, CellOwner owner) const noexcept {
  switch (owner) {
    case CellOwner::kFirstArrived:
      return false;
    case CellOwner::kStrongest:
      return point.intensity > intensity_[cell];
    case CellOwner::kNearest:
      return point.ground_range_m < ground_range_m_[cell];
    case CellOwner::kFarthest:
      return point.ground_range_m > ground_range_m_[cell];
  }
  return false;
}

bool RangeImage::place_second(std::size_t cell, const Return& point, CellOwner owner,
                              std::uint32_t number) noexcept {
  if (overflow_used_ == overflow_.size()) return false;
  OverflowReturn& extra = overflow_[overflow_used_++];
  extra.cell = static_cast<std::uint32_t>(cell);
  if (owns(cell, point, owner)) {
    extra.point = {x_m_[cell], y_m_[cell], z_m_[cell], ground_range_m_[cell], intensity_[cell]};
    extra.return_index = return_index_[cell];
    write(cell, point, number);
  } else {
    extra.point = point;
    extra.return_index = number;
  }
  return true;
}

}  // namespace terracut::frame
