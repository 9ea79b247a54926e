// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <limits>

#include "firmware_io/frame/image_shape.hpp"

namespace terracut::frame {

/// The height in a cell without a return: every comparison with NaN is false.
inline constexpr float kNoHeight_m = std::numeric_limits<float>::quiet_NaN();

/// Points in the cells of a range image, one value per cell and plane; the planes are those of a
/// RangeImage, or computed by PointRing. Vehicle frame, metres.
struct PointPlanes {
  const float *x_m, *y_m, *z_m, *ground_range_m;
  /// Prefetches cells of a row: for ranges so short that the processor does not prefetch them
  /// itself.
  void fetch(std::size_t begin, std::size_t end) const noexcept {
    constexpr std::size_t kCellsPerLine = 16;
    for (std::size_t cell = begin; cell < end; cell += kCellsPerLine) {
      __builtin_prefetch(&x_m[cell]);
      __builtin_prefetch(&y_m[cell]);
      __builtin_prefetch(&z_m[cell]);
      __builtin_prefetch(&ground_range_m[cell]);
    }
  }
};

}  // namespace terracut::frame
