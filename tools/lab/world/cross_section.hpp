// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "road.hpp"

namespace terracut::world {

/// The strips on one side of the road with their heights added up from the centre line outwards.
class CrossSection {
 public:
  struct Band {
    Strip strip;
    double inner_m = 0, outer_m = 0;  ///< Distance of its edges from the centre line.
    double inner_height_m = 0;  ///< At the inner edge, over the centre line, steps not counted.
    double steps_m = 0;         ///< Sum of the steps from the centre line to here.
    double inner_bumps_m = 0;   ///< Bumps of the band inside of this one.
    double unevenness = 0;      ///< Bound on the slope of its bumps and dropped kerbs.
  };

  explicit CrossSection(const RoadSide& side);

  [[nodiscard]] const Band& band_at(double distance_m) const noexcept;

  /// Height over the centre line without bumps, of `band` even where it does not reach.
  [[nodiscard]] double height_m(const Band& band, double s_m, double distance_m) const noexcept;
  /// How high the bumps are here: they fade in from those of the band inside.
  [[nodiscard]] static double bumps_m(const Band& band, double distance_m) noexcept;

  /// Bound on the slope of any band in any direction, steps aside.
  [[nodiscard]] double steepest() const noexcept;
  /// The highest rise by steps alone.
  [[nodiscard]] double highest_step_m() const noexcept;

 private:
  /// 1 where kerbs have their full height, less where they are dropped.
  [[nodiscard]] double step_share(double s_m) const noexcept;

  std::vector<Band> bands_;
  double dropped_every_m_, dropped_at_m_, dropped_share_;
};

}  // namespace terracut::world
