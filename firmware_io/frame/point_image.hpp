// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// Makes images of points of decoded frames, for whoever needs all points: one frame after the
/// other, in the same memory.
///
/// Takes its memory in the constructor. One thread; real-time safe.
class PointImage {
 public:
  /// `return_capacity` is that of the frames, and `reader` the sensor's.
  PointImage(ImageShape shape, std::size_t return_capacity, std::unique_ptr<TileReader> reader,
             memory::FixedMemory& memory)
      : reader_(std::move(reader)), image_(shape, return_capacity, memory) {}

  /// Returns the image of a frame, valid until the next call. `motions` are the frame's if its
  /// points are to be moved (Frame::motions), else empty.
  const RangeImage& make(const MeasuredReturns& returns,
                         std::span<const PlanarMotions> motions = {}) noexcept
      TERRACUT_NONBLOCKING {
    image_.fill(returns, *reader_);
    image_.move(motions);
    return image_;
  }

 private:
  std::unique_ptr<TileReader> reader_;
  RangeImage image_;
};

}  // namespace terracut::frame
