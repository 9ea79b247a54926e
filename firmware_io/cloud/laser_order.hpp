// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/cloud/cloud.hpp"

namespace terracut::cloud {

/// The ring that each laser's number stands for, 0 the highest; scan::kNoRing for lasers of which
/// nothing is known.
using RingOfLaser = std::vector<std::int16_t>;

/// Elevations of what each laser measured, from which the order of the lasers follows, whatever
/// their numbers.
class LaserElevations {
 public:
  explicit LaserElevations(std::size_t lasers) : seen_(lasers), samples_(lasers) {}

  /// `laser`: below the number given at construction, one a point.
  void add(std::span<const scan::ScanPoint> points, std::span<const std::uint16_t> laser);

  /// Lasers without any point have the ring between their neighbours' where the numbers go up or
  /// down with the elevation; else none, and the others have all rings from 0 on.
  [[nodiscard]] RingOfLaser order();

 private:
  struct Sample {
    double distance_m, elevation_rad;
  };

  [[nodiscard]] static double typical_elevation_rad(std::vector<Sample>& samples);

  std::vector<std::size_t> seen_;  ///< Points, by the laser's number, as samples_.
  std::vector<std::vector<Sample>> samples_;
};

}  // namespace terracut::cloud
