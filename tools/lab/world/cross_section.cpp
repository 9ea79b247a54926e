// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cross_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bumps.hpp"

namespace terracut::world {
namespace {

// Half the length of a dropped kerb's lowest part, and the length of each ramp beside it.
constexpr double kDroppedHalf_m = 1.8;
constexpr double kDroppedRamp_m = 1.5;
// Bumps grow to their full height over this distance from a strip's edge, so that neighbouring
// strips meet.
constexpr double kBumpsJoin_m = 2.0;

double smoothstep(double from, double to, double value) noexcept {
  const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}

}  // namespace

CrossSection::CrossSection(const RoadSide& side)
    : dropped_every_m_(side.dropped_every_m),
      dropped_at_m_(side.dropped_at_m),
      dropped_share_(side.dropped_share) {
  Band band;
  for (const Strip& strip : side.strips) {
    band.strip = strip;
    band.outer_m = band.inner_m + strip.width_m;
    band.steps_m += strip.step_m;
    const double lowered_m =
        dropped_every_m_ > 0 ? std::abs(band.steps_m) * (1 - dropped_share_) : 0;
    band.unevenness = 1.5 * lowered_m / kDroppedRamp_m +
                      steepest_of_bumps(std::max(strip.bumps_m, band.inner_bumps_m));
    bands_.push_back(band);
    band.inner_m = band.outer_m;
    band.inner_height_m += strip.width_m * strip.slope;
    band.inner_bumps_m = strip.bumps_m;
  }
  bands_.back().outer_m = std::numeric_limits<double>::infinity();
}

const CrossSection::Band& CrossSection::band_at(double distance_m) const noexcept {
  auto band = bands_.begin();
  while (distance_m >= band->outer_m) ++band;
  return *band;
}

double CrossSection::step_share(double s_m) const noexcept {
  if (dropped_every_m_ <= 0) return 1;
  const double away_m = std::abs(std::remainder(s_m - dropped_at_m_, dropped_every_m_));
  const double raised = smoothstep(kDroppedHalf_m, kDroppedHalf_m + kDroppedRamp_m, away_m);
  return dropped_share_ + (1 - dropped_share_) * raised;
}

double CrossSection::height_m(const Band& band, double s_m, double distance_m) const noexcept {
  const double smooth_m = band.inner_height_m + band.strip.slope * (distance_m - band.inner_m);
  return band.steps_m == 0 ? smooth_m : smooth_m + band.steps_m * step_share(s_m);
}

double CrossSection::bumps_m(const Band& band, double distance_m) noexcept {
  if (band.strip.bumps_m == band.inner_bumps_m) return band.strip.bumps_m;
  const double share = smoothstep(0, kBumpsJoin_m, distance_m - band.inner_m);
  return band.inner_bumps_m + (band.strip.bumps_m - band.inner_bumps_m) * share;
}

double CrossSection::steepest() const noexcept {
  double steepest = 0;
  for (const Band& band : bands_) {
    steepest = std::max(steepest, std::abs(band.strip.slope) + band.unevenness);
  }
  return steepest;
}

double CrossSection::highest_step_m() const noexcept {
  double highest_m = 0;
  for (const Band& band : bands_) highest_m = std::max(highest_m, std::abs(band.steps_m));
  return highest_m;
}

}  // namespace terracut::world
