// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/range_image.hpp"

#include <algorithm>

namespace terracut::pipeline {

RangeImage::RangeImage(ImageShape shape, std::size_t overflow_capacity, rt::FixedMemory& memory)
    : shape_(shape),
      stride_(shape.stride()),
      stamp_(memory.take<std::uint32_t>("range images", shape.cells())),
      x_m_(memory.take<float>("range images", shape.cells())),
      y_m_(memory.take<float>("range images", shape.cells())),
      z_m_(memory.take<float>("range images", shape.cells())),
      ground_range_m_(memory.take<float>("range images", shape.cells())),
      intensity_(memory.take<std::uint8_t>("range images", shape.cells())),
      return_index_(memory.take<std::uint32_t>("range images", shape.cells())),
      overflow_(memory.take<OverflowReturn>("range images", overflow_capacity)) {}

void RangeImage::clear() noexcept {
  returns_ = 0;
  overflow_used_ = 0;
  if (++generation_ == 0) {  // stamps of 2^32 turns ago would look alive
    std::fill(stamp_.begin(), stamp_.end(), 0U);
    generation_ = 1;
  }
}

bool RangeImage::place_overflow(std::size_t cell, const Return& echo) noexcept {
  if (overflow_used_ == overflow_.size()) return false;
  overflow_[overflow_used_++] = {echo, static_cast<std::uint32_t>(cell), returns_++};
  return true;
}

}  // namespace terracut::pipeline
