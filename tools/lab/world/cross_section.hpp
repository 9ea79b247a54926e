// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "road.hpp"

namespace terracut::world {

/// The strips on one side of the road with their heights summed from the centre line outwards.
class CrossSection {
 public:
  struct Band {
    Strip strip;
    double inner_m = 0, outer_m = 0;  ///< Distance of its edges from the centre line.
    double inner_height_m = 0;        ///< At the inner edge, above the centre line, without steps.
    double steps_m = 0;               ///< Sum of the steps from the centre line to here.
    double inner_bumps_m = 0;         ///< Bumps of the next band inside.
    double unevenness = 0;            ///< Bound on the slope of its bumps and dropped kerbs.
  };

  explicit CrossSection(const RoadSide& side);

  [[nodiscard]] const Band& band_at(double distance_m) const noexcept;

  /// Returns the height of `band` above the centre line, without bumps; also for places beyond its
  /// edges.
  [[nodiscard]] double height_m(const Band& band, double s_m, double distance_m) const noexcept;
  /// Returns the height of a band's bumps at a distance from the centre line. At its inner edge it
  /// begins with the bumps of the band before.
  [[nodiscard]] static double bumps_m(const Band& band, double distance_m) noexcept;

  /// Returns an upper bound of the slope of all bands in any direction, without steps.
  [[nodiscard]] double steepest() const noexcept;
  /// Returns an upper bound of how far steps alone raise or lower a place, compared to the centre
  /// line.
  [[nodiscard]] double highest_step_m() const noexcept;

 private:
  /// Returns 1 where kerbs have their full height, less where they are dropped.
  [[nodiscard]] double step_share(double s_m) const noexcept;

  std::vector<Band> bands_;
  double dropped_every_m_, dropped_at_m_, dropped_share_;
};

}  // namespace terracut::world
