// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/cloud/cloud.hpp"

namespace terracut::cloud {

/// The ring of each laser, indexed by laser number; 0 is the highest ring, scan::kNoRing means that
/// nothing is known of the laser.
using RingOfLaser = std::vector<std::int16_t>;

/// Collects the elevations that each laser measured and sorts the lasers by elevation, whatever
/// their numbers.
class LaserElevations {
 public:
  explicit LaserElevations(std::size_t lasers) : seen_(lasers), samples_(lasers) {}

  /// Adds a cloud. `laser` has one number per point, below the count given to the constructor.
  void add(std::span<const scan::ScanPoint> points, std::span<const std::uint16_t> laser);

  /// Returns the ring of each laser. If laser numbers ascend or descend with elevation, a laser
  /// without points gets the ring between its neighbours. If they do not, it gets kNoRing, and the
  /// other lasers are numbered without a gap from 0 on.
  [[nodiscard]] RingOfLaser order();

 private:
  struct Sample {
    double distance_m, elevation_rad;
  };

  [[nodiscard]] static double typical_elevation_rad(std::vector<Sample>& samples);

  std::vector<std::size_t> seen_;  ///< Number of points, indexed by laser.
  std::vector<std::vector<Sample>> samples_;
};

}  // namespace terracut::cloud
