// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::test {

/// An upright box on level ground, its sides along the axes; beams from the sensor's height.
struct Box {
  double near_m, far_m;    ///< x
  double right_m, left_m;  ///< y
  double bottom_m, top_m;  ///< z above the ground
};

/// Distance to the box along a beam, by its three pairs of faces; infinite where it is missed.
inline double distance_to(const Box& box, double azimuth_rad, double elevation_rad,
                          double height_m) {
  const double across = std::cos(elevation_rad);
  const double direction[3] = {across * std::cos(azimuth_rad), -across * std::sin(azimuth_rad),
                               std::sin(elevation_rad)};
  const double low[3] = {box.near_m, box.right_m, box.bottom_m - height_m};
  const double high[3] = {box.far_m, box.left_m, box.top_m - height_m};
  double enter = 0, leave = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = low[axis] / direction[axis];
    const double b = high[axis] / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave && enter > 0 ? enter : INFINITY;
}

/// Level ground with boxes on, or over, it.
inline BeamCast ground_with_boxes(std::vector<Box> boxes, double height_m = 1.73) {
  return [=](double azimuth_rad, double elevation_rad) {
    const double ground = flat_ground(height_m)(azimuth_rad, elevation_rad);
    double nearest = ground > 0 ? ground : INFINITY;
    for (const Box& box : boxes) {
      nearest = std::min(nearest, distance_to(box, azimuth_rad, elevation_rad, height_m));
    }
    return nearest;
  };
}

/// A plane through the ground below the sensor that rises `slope` metres a metre ahead.
inline BeamCast sloping_ground(double slope, double height_m = 1.73) {
  return [=](double azimuth_rad, double elevation_rad) {
    const double ahead = std::cos(elevation_rad) * std::cos(azimuth_rad);
    return height_m / (slope * ahead - std::sin(elevation_rad));
  };
}

/// One synthetic frame, and what a method made of it.
struct BoxScene {
  static constexpr frame::ImageShape kShape{64, 1000};

  memory::FixedMemory memory;
  mount::RingProfile profile = even_profile();
  frame::RangeImage image{kShape, 1000, memory};

  void cast(const BeamCast& beams) { cast_frame(profile, beams, image); }

  /// Share of the returns `of` picks by x, y, z that carry `label`; -1 where it picks none.
  double share(std::span<const frame::Label> labels, frame::Label label,
               const std::function<bool(float, float, float)>& of) const {
    int all = 0, hits = 0;
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      if (!image.has_return(cell)) continue;
      if (!of(image.x_m()[cell], image.y_m()[cell], image.z_m()[cell])) continue;
      ++all;
      hits += labels[image.return_index()[cell]] == label ? 1 : 0;
    }
    return all == 0 ? -1.0 : static_cast<double>(hits) / all;
  }
};

}  // namespace terracut::test
