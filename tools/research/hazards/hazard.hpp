// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <vector>

#include "tools/lab/world/shapes.hpp"

namespace terracut::hazards {

/// What lies, stands or gapes where a vehicle may drive. Its frame: origin on the ground, x along
/// its heading, y left, z away from the ground, metres.
struct Hazard {
  std::vector<world::Shape> body{};
  /// What comes with it, as a truck with its tail lift: it hides what is behind it, and is no part
  /// of the hazard.
  std::vector<world::Shape> beside{};
  /// A shaft below the ground, whose upper end is open; none for a hazard that stands.
  std::optional<world::Shape> hole{};
  double nearest_m = 0, farthest_m = 1000;  ///< Where it is put, from the sensor.
  bool faces_sensor = false;                ///< Heads away from the sensor, to 15 degrees.

  /// The extent of body and hole along x and y, and the body's height.
  struct Extent {
    double least_x_m = 0, most_x_m = 0, least_y_m = 0, most_y_m = 0, height_m = 0;
  };
  [[nodiscard]] Extent extent() const noexcept;
};

}  // namespace terracut::hazards
