// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"

namespace terracut::mount {

/// One recorded return, as far as a ring's ground distance needs it.
struct RingObservation {
  int row = 0;               ///< Of the range image, [0, rings).
  float ground_range_m = 0;  ///< Horizontal distance from the sensor.
  bool is_ground = false;
};

/// Measures the profile's ground distances from recordings, as the paper obtains them: the mean
/// horizontal distance of each ring's ground returns. Feed frames, then read the profile. Memory is
/// fixed by the constructor. Not real-time (it is cheap, but its place is `terracut calibrate`).
class RingProfileEstimate {
 public:
  /// Returns that differ from the geometry's distance by more than this factor are not this plane
  /// (kerbs, banks, mislabelled walls) and are left out.
  static constexpr double kMaxFactor = 1.5;

  /// `geometry`: ring_profile(), the start and the fall-back. `min_returns`: a ring with fewer
  /// ground returns keeps the geometry's distance.
  explicit RingProfileEstimate(const RingProfile& geometry, std::uint64_t min_returns = 200);

  /// Observations of rows outside the profile or with a range that is not finite are ignored.
  void add(std::span<const RingObservation> observations) noexcept;

  /// Geometry with the measured distances put in. Where two neighbouring rings come out in the
  /// wrong order (the higher one nearer) though geometry has them right, both keep the geometry's
  /// distance.
  [[nodiscard]] RingProfile profile() const;

  /// Rings whose distance in profile() is measured.
  [[nodiscard]] int measured_rings() const;

 private:
  struct Sum {
    double distance_m = 0;
    std::uint64_t returns = 0;
  };

  [[nodiscard]] static bool overtakes(const RingProfile& profile, std::size_t row);
  [[nodiscard]] bool is_measured(const RingProfile& profile, std::size_t row) const;
  bool give_back(RingProfile& profile, std::size_t row) const;

  RingProfile geometry_;
  std::uint64_t min_returns_;
  std::vector<Sum> sums_;
};

}  // namespace terracut::mount
