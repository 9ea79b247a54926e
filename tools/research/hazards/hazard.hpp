// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <vector>

#include "tools/lab/world/shapes.hpp"

namespace terracut::hazards {

/// An object or a hole where a vehicle may drive. In the frame of its shapes the origin is on the
/// ground, x points along the heading, y to the left and z away from the ground, metres.
struct Hazard {
  std::vector<world::Shape> body{};
  /// Shapes that hide the ground behind them but are not part of the hazard, such as the truck of a
  /// tail lift.
  std::vector<world::Shape> beside{};
  /// A shaft below the ground with an open upper end, if the hazard is a hole.
  std::optional<world::Shape> hole{};
  double nearest_m = 0, farthest_m = 1000;  ///< Allowed distances from the sensor.
  bool faces_sensor = false;  ///< True: its heading is away from the sensor, +-15 deg.

  /// The extent of body and hole along x and y, and the body's height.
  struct Extent {
    double least_x_m = 0, most_x_m = 0, least_y_m = 0, most_y_m = 0, height_m = 0;
  };
  [[nodiscard]] Extent extent() const noexcept;
};

}  // namespace terracut::hazards
