// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cloud_file.hpp"

namespace terracut::datasets {

/// The ring that each laser's number stands for; scan::kNoRing for lasers of which nothing is
/// known.
using RingOfLaser = std::vector<std::int16_t>;

/// Finds `rings` of a scan whose points have the numbers of their lasers.
void find_rings(const RingOfLaser& ring_of_laser, LabelledScan& scan);

/// Elevations of what each laser measured, from which the order of the lasers follows, whatever
/// their numbers.
class LaserElevations {
 public:
  explicit LaserElevations(int lasers)
      : seen_(static_cast<std::size_t>(lasers)), samples_(seen_.size()) {}

  void add(const LabelledScan& scan);

  /// The highest laser is ring 0; lasers without any point have no ring.
  [[nodiscard]] RingOfLaser order();

 private:
  struct Sample {
    double distance_m, elevation_rad;
  };

  [[nodiscard]] static double typical_elevation_rad(std::vector<Sample>& samples);

  std::vector<std::size_t> seen_;  ///< Points, by the laser's number, as samples_.
  std::vector<std::vector<Sample>> samples_;
};

}  // namespace terracut::datasets
