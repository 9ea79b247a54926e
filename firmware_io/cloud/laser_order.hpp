// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/cloud/cloud.hpp"

namespace terracut::cloud {

/// The ring of each laser by its number, 0 the highest; scan::kNoRing for lasers of which nothing
/// is known.
using RingOfLaser = std::vector<std::int16_t>;

/// Collects the elevations that each laser measured and derives the order of the lasers, whatever
/// their numbers.
class LaserElevations {
 public:
  explicit LaserElevations(std::size_t lasers) : seen_(lasers), samples_(lasers) {}

  /// `laser` has one number a point, below the count given to the constructor.
  void add(std::span<const scan::ScanPoint> points, std::span<const std::uint16_t> laser);

  /// Returns the order. If the numbers ascend or descend with the elevation, lasers without points
  /// get the ring between their neighbours'; else they get none, and the others have all rings from
  /// 0 on.
  [[nodiscard]] RingOfLaser order();

 private:
  struct Sample {
    double distance_m, elevation_rad;
  };

  [[nodiscard]] static double typical_elevation_rad(std::vector<Sample>& samples);

  std::vector<std::size_t> seen_;  ///< The number of points, by laser.
  std::vector<std::vector<Sample>> samples_;
};

}  // namespace terracut::cloud
