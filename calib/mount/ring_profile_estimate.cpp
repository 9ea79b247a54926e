// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/ring_profile_estimate.hpp"

namespace terracut::mount {

RingProfileEstimate::RingProfileEstimate(const RingProfile& geometry, std::uint64_t min_returns)
    : geometry_(geometry), min_returns_(min_returns), sums_(geometry.rings.size()) {}

void RingProfileEstimate::add(std::span<const RingObservation> observations) noexcept {
  for (const RingObservation& seen : observations) {
    if (!seen.is_ground || seen.row < 0) continue;
    const auto row = static_cast<std::size_t>(seen.row);
    if (row >= sums_.size()) continue;
    // Leaves out NaN, too, and rings that by geometry never reach the ground (infinite distance).
    const double factor = seen.ground_range_m / geometry_.rings[row].ground_distance_m;
    if (!(factor <= kMaxFactor && factor >= 1.0 / kMaxFactor)) continue;
    sums_[row].distance_m += seen.ground_range_m;
    ++sums_[row].returns;
  }
}

RingProfile RingProfileEstimate::profile() const {
  RingProfile profile = geometry_;
  for (std::size_t row = 0; row < sums_.size(); ++row) {
    if (sums_[row].returns < min_returns_ || sums_[row].returns == 0) continue;
    profile.rings[row].ground_distance_m =
        sums_[row].distance_m / static_cast<double>(sums_[row].returns);
  }
  // A ring whose returns all lie on a kerb or a bank may overtake the next higher ring; then both
  // get back the distance of the geometry.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t row = 0; row + 1 < sums_.size(); ++row) {
      if (!overtakes(profile, row) || overtakes(geometry_, row)) continue;
      changed = give_back(profile, row) || changed;
      changed = give_back(profile, row + 1) || changed;
    }
  }
  return profile;
}

int RingProfileEstimate::measured_rings() const {
  const RingProfile measured = profile();
  int count = 0;
  for (std::size_t row = 0; row < sums_.size(); ++row) {
    count += is_measured(measured, row) ? 1 : 0;
  }
  return count;
}

bool RingProfileEstimate::overtakes(const RingProfile& profile, std::size_t row) {
  return profile.rings[row].ground_distance_m > profile.rings[row + 1].ground_distance_m;
}

bool RingProfileEstimate::is_measured(const RingProfile& profile, std::size_t row) const {
  return profile.rings[row].ground_distance_m != geometry_.rings[row].ground_distance_m;
}

bool RingProfileEstimate::give_back(RingProfile& profile, std::size_t row) const {
  const bool was_measured = is_measured(profile, row);
  profile.rings[row].ground_distance_m = geometry_.rings[row].ground_distance_m;
  return was_measured;
}

}  // namespace terracut::mount
