// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"

namespace terracut::mount {

/// The part of one recorded return that a ring's ground distance needs.
struct RingObservation {
  int row = 0;               ///< Row of the range image, [0, rings).
  float ground_range_m = 0;  ///< Horizontal distance from the sensor.
  bool is_ground = false;
};

/// Measures the profile's ground distances from recordings, as the paper does: the mean horizontal
/// distance of each ring's ground returns. Feed frames, then read the profile. Memory is fixed by
/// the constructor. Cheap, but not real-time: `terracut calibrate` uses it.
class RingProfileEstimate {
 public:
  /// Largest factor between a return's distance and the geometry's; others are left out, as they
  /// are not on this plane (kerbs, banks, mislabelled walls).
  static constexpr double kMaxFactor = 1.5;

  /// `geometry` is ring_profile()'s, the start and the fall-back. A ring with fewer than
  /// `min_returns` ground returns keeps the geometry's distance.
  explicit RingProfileEstimate(const RingProfile& geometry, std::uint64_t min_returns = 200);

  /// Ignores observations of rows outside the profile or with a range that is not finite.
  void add(std::span<const RingObservation> observations) noexcept;

  /// Returns the geometry with the measured distances. Where measuring reverses the order of two
  /// neighbouring rings (the higher one nearer), both keep the geometry's distance.
  [[nodiscard]] RingProfile profile() const;

  /// Returns the number of rings whose distance in profile() is measured.
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
