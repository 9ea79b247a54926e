// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/frame/range_image.hpp"

namespace terracut::frame {

/// One return of a frame and its place in the image.
struct PlacedReturn {
  std::uint32_t return_index = 0;  ///< Number of the return, from 0 in order of arrival.
  int row = 0;
  int column = 0;
  Return point;
};

/// Calls `visit(const PlacedReturn&)` once for every return of the frame: first the cells row by
/// row, then the overflow list (so not in order of arrival).
template <class Visitor>
void for_each_return(const RangeImage& image, Visitor&& visit) {
  const int stride = image.shape().stride();
  for (int row = 0; row < image.shape().rows; ++row) {
    for (int column = 0; column < image.shape().columns; ++column) {
      const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(stride) +
                        static_cast<std::size_t>(column);
      if (!image.has_return(cell)) continue;
      visit(PlacedReturn{image.return_index()[cell],
                         row,
                         column,
                         {image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                          image.ground_range_m()[cell], image.intensity()[cell]}});
    }
  }
  for (const OverflowReturn& extra : image.overflow()) {
    visit(PlacedReturn{extra.return_index, static_cast<int>(extra.cell) / stride,
                       static_cast<int>(extra.cell) % stride, extra.point});
  }
}

}  // namespace terracut::frame
