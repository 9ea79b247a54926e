// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "grade_profile.hpp"
#include "materials.hpp"

namespace terracut::world {

/// A place along and beside the road. s is the world's x; d is the distance from the centre line,
/// positive to the left.
struct RoadPoint {
  double s_m = 0, d_m = 0;
};

/// One band of ground that runs along the road. Bands follow each other outwards from the centre.
struct Strip {
  double width_m = 0;  ///< > 0.3; ignored for the last of a side, which is endless.
  double step_m = 0;   ///< Height of the vertical face at the inner edge; positive for a kerb.
  double slope = 0;    ///< Rise per metre outwards.
  double bumps_m = 0;  ///< Greatest height of smooth random bumps.
  Truth truth = Truth::kRoad;
  Material material = Material::kAsphalt;
};

/// The strips on one side of the centre line.
struct RoadSide {
  std::vector<Strip> strips;   ///< At least one.
  double dropped_every_m = 0;  ///< Distance between dropped kerbs; 0 = none.
  double dropped_at_m = 0;     ///< The s of one dropped kerb.
  double dropped_share = 1;    ///< The share of the step's height left there.
};

/// The shape of a road: its plan, its grade, and the strips beside it.
struct Road {
  double bend_m = 0;           ///< Half the lateral amplitude of the bends; 0 = straight.
  double bend_length_m = 400;  ///< Distance between bends of the same hand.
  GradeProfile grade;
  RoadSide left, right;
  double lane_mark_d_m = -1;  ///< Dashed paint at this |d|; < 0 = none.

  /// Return y and slope of the centre line at s.
  [[nodiscard]] double centre_y_m(double s_m) const noexcept;
  [[nodiscard]] double centre_slope(double s_m) const noexcept;
  /// Returns the road's direction at s, from the x axis to the left.
  [[nodiscard]] double heading_rad(double s_m) const noexcept;

  /// A position of the world in terms of the road, and the centre line's slope at its s.
  struct Location {
    RoadPoint place;
    double centre_slope = 0;
  };
  [[nodiscard]] Location locate(double x_m, double y_m) const noexcept;
  /// Returns the world's y of a road point; its x is s.
  [[nodiscard]] double y_m(const RoadPoint& place) const noexcept;
};

}  // namespace terracut::world
