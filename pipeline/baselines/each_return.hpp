// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

#include "firmware_io/frame/range_image.hpp"

namespace terracut::baselines {

/// Where a return is, in the vehicle frame, and in which column of the image.
struct Place {
  float x_m, y_m, z_m;
  float ground_range_m;
  int column;
};

/// Calls `visit(place)` for every return of the frame, those on the overflow list included: methods
/// on a map see points, not an image.
template <class Visit>
void each_return(const frame::RangeImage& image, Visit visit) noexcept {
  const frame::ImageShape& shape = image.shape();
  for (int row = 0; row < shape.rows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape.stride());
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = first + static_cast<std::size_t>(column);
      if (!image.has_return(cell)) continue;
      visit(Place{image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                  image.ground_range_m()[cell], column});
    }
  }
  for (const frame::OverflowReturn& extra : image.overflow()) {
    const frame::Return& point = extra.point;
    visit(Place{point.x_m, point.y_m, point.z_m, point.ground_range_m,
                static_cast<int>(extra.cell % static_cast<std::uint32_t>(shape.stride()))});
  }
}

}  // namespace terracut::baselines
