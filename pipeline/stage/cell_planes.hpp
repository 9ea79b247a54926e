// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::stage {

inline constexpr std::uint8_t kSteep = 1;
/// How many labels may be read beyond the last one, for whole vectors.
inline constexpr std::size_t kReadBeyond = 32;

/// The data that one stage passes to the next: planes over the range image's cells, row-major with
/// the image's stride. The stages write them one after the other on one thread.
struct CellPlanes {
  /// Height above the ground reference of the elevation map, metres; NaN in cells without a return,
  /// so that every comparison with such a cell is false.
  std::span<float> height_m;
  /// The label given so far; kNone in cells without a return.
  std::span<frame::Label> label;
  /// Bit kSteep is set where the adjacent points test found a steep step at this return; the other
  /// bits are that test's own.
  std::span<std::uint8_t> steep;

  CellPlanes(frame::ImageShape shape, memory::FixedMemory& memory)
      : height_m(memory.take<float>("cell planes", shape.cells())),
        label(memory.take<frame::Label>("cell planes", shape.cells() + kReadBeyond)
                  .first(shape.cells())),
        steep(memory.take<std::uint8_t>("cell planes", shape.cells())) {
    std::ranges::fill(height_m, std::numeric_limits<float>::quiet_NaN());  // padding cells keep NaN
  }
};

}  // namespace terracut::stage
