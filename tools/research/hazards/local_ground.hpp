// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>

namespace terracut::hazards {

/// A plane through the ground around a position.
struct LocalGround {
  double height_m = 0;                            ///< Height of the plane at that position.
  double rise_x = 0, rise_y = 0;                  ///< Rise per metre.
  [[nodiscard]] Eigen::Vector3d normal() const {  ///< Upwards, length 1.
    return Eigen::Vector3d(-rise_x, -rise_y, 1).normalized();
  }
};

/// Fits a plane to points around (x, y). Points far from the plane have less weight. Along a
/// direction in which the points hardly spread, as across a single row, the plane is level. Returns
/// none for fewer than 6 points.
[[nodiscard]] std::optional<LocalGround> local_ground(std::span<const Eigen::Vector3d> points,
                                                      double x_m, double y_m);

}  // namespace terracut::hazards
