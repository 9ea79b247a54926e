// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/points/labelled_point.hpp"

namespace terracut::test {

/// Returns the return of a cell on level ground; what is higher than 5 cm is an obstacle.
inline points::LabelledPoint point_of_cell(const frame::RangeImage& image, int row,
                                           std::size_t cell) {
  const float z_m = image.z_m()[cell];
  return {image.x_m()[cell],
          image.y_m()[cell],
          z_m,
          0,
          z_m > 0.05F ? frame::Label::kObstacle : frame::Label::kGround,
          static_cast<std::uint16_t>(row),
          0};
}

}  // namespace terracut::test
