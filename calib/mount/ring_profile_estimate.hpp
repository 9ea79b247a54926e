// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"

namespace terracut::mount {

/// The part of one recorded return that is needed to measure a ring's ground distance.
struct RingObservation {
  int row = 0;               ///< Row of the range image, [0, rings).
  float ground_range_m = 0;  ///< Horizontal distance from the sensor.
  bool is_ground = false;
};

/// Measures the ground distance of each ring from recordings, as the paper does: the mean
/// horizontal distance of the ring's ground returns. Add frames, then read the profile. The
/// constructor takes all memory. Cheap, but not real-time: `terracut calibrate` uses it.
class RingProfileEstimate {
 public:
  /// A return is left out if its distance differs from the geometry's by more than this factor: it
  /// does not lie on the ground plane (kerbs, banks, mislabelled walls).
  static constexpr double kMaxFactor = 1.5;

  /// `geometry` comes from ring_profile(). A ring with fewer than `min_returns` ground returns
  /// keeps the distance that `geometry` gives.
  explicit RingProfileEstimate(const RingProfile& geometry, std::uint64_t min_returns = 200);

  /// Adds returns. Ignores rows outside the profile and ranges that are not finite.
  void add(std::span<const RingObservation> observations) noexcept;

  /// Returns the geometry with the measured distances. If the measured order of two neighbouring
  /// rings is reversed (the higher one is nearer), both keep the geometry's distance.
  [[nodiscard]] RingProfile profile() const;

  /// Returns the number of rings for which profile() has a measured distance.
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
