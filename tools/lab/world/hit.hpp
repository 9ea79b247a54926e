// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "materials.hpp"

namespace terracut::world {

/// A straight line of sight; its direction has length 1.
struct SightLine {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();

  [[nodiscard]] Eigen::Vector3d at(double way_m) const noexcept {
    return origin + way_m * direction;
  }
};

/// The end of a line of sight, on a surface.
struct Hit {
  double way_m = 0;  ///< Distance from the line's origin.
  /// Of the surface, length 1, towards the line.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Truth truth = Truth::kRoad;
  Material material = Material::kAsphalt;
  std::uint16_t instance = 0;  ///< Number of the object, if it has_instances(truth); else 0.

  /// Returns the entry of a label file.
  [[nodiscard]] std::uint32_t label() const noexcept {
    return static_cast<std::uint32_t>(truth) | std::uint32_t{instance} << 16;
  }
};

}  // namespace terracut::world
