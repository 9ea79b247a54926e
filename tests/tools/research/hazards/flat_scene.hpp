// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/hazards/labelled_frame.hpp"

namespace terracut::hazards {

/// Flat ground 3.5 to 70 m around a sensor 1.73 m above it: 64 rows, 0.2 degrees a column. Road
/// within 4 m of the x axis, sidewalk within 8 m, terrain beyond. Optionally a car across the road.
class FlatScene {
 public:
  static constexpr double kHeight_m = 1.73;

  explicit FlatScene(double car_at_m = std::numeric_limits<double>::infinity()) {
    for (int row = 0; row < shape.rows; ++row) {
      const double elevation_rad = beams::deg_to_rad(-25 + row * 0.37);
      profile.rings.push_back(mount::ring(elevation_rad, 0, profile.mount));
      const double range_m = -kHeight_m / std::tan(elevation_rad);
      if (!(range_m > 0 && range_m < 70)) continue;
      for (int column = 0; column < shape.columns; ++column) {
        const double azimuth_rad = -beams::deg_to_rad((column + 0.5) * shape.pitch_deg());
        add(row, column, range_m, azimuth_rad, car_at_m);
      }
    }
  }

  [[nodiscard]] LabelledFrame labelled() const {
    return labelled_frame(image, truth, profile.mount, classes);
  }

  frame::ImageShape shape{.rows = 64, .columns = 1800};
  memory::FixedMemory memory;
  frame::RangeImage image{shape, shape.cells(), memory};
  std::vector<std::uint32_t> truth;
  mount::RingProfile profile;
  datasets::ClassTable classes = *datasets::built_in_table("semantickitti");

 private:
  void add(int row, int column, double range_m, double azimuth_rad, double car_at_m) {
    double x_m = range_m * std::cos(azimuth_rad), y_m = range_m * std::sin(azimuth_rad), z_m = 0;
    std::uint32_t id = std::abs(y_m) < 4 ? 40 : std::abs(y_m) < 8 ? 48 : 72;
    if (const double share = car_at_m / x_m; x_m > 0 && share < 1 && std::abs(share * y_m) < 4) {
      x_m *= share, y_m *= share, z_m = kHeight_m * (1 - share);
      id = 10;
    }
    image.place(row, column,
                {static_cast<float>(x_m), static_cast<float>(y_m), static_cast<float>(z_m),
                 static_cast<float>(std::hypot(x_m, y_m)), 100});
    truth.push_back(id);
  }
};

}  // namespace terracut::hazards
