// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hazard.hpp"

#include <algorithm>

namespace terracut::hazards {

Hazard::Extent Hazard::extent() const noexcept {
  Extent extent;
  const auto add = [&](const world::Shape& shape) {
    const Eigen::Vector3d least = shape.centre - shape.half, most = shape.centre + shape.half;
    extent.least_x_m = std::min(extent.least_x_m, least.x());
    extent.most_x_m = std::max(extent.most_x_m, most.x());
    extent.least_y_m = std::min(extent.least_y_m, least.y());
    extent.most_y_m = std::max(extent.most_y_m, most.y());
    extent.height_m = std::max(extent.height_m, most.z());
  };
  for (const world::Shape& shape : body) add(shape);
  if (hole) add(*hole);
  return extent;
}

}  // namespace terracut::hazards
