// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "disturbance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace terracut::hazards {
namespace {

using world::Random;

/// Moves a share of the low returns to 1.1 to 1.6 times their distance along the beam. Low returns
/// are nearer than 40 m and more than 1.2 m below the sensor (below 0.53 m for a sensor 1.73 m
/// high).
template <int kPerMille>
bool ghost(const LabelledFrame& frame, std::uint32_t i, Random& random, MovedReturn& moved) {
  constexpr double kLow_m = 1.2, kFarthest_m = 40;
  if (frame.at[i].z() >= frame.sensor.z() - kLow_m || frame.ground_range_m(i) >= kFarthest_m) {
    return false;
  }
  if (!random.chance(kPerMille / 1000.0)) return false;
  moved.range_m = frame.range_m[i] * random.uniform(1.1, 1.6);
  return true;
}

/// Moves half of the ground returns in two puddles, ahead and behind, to 1.3 to 2.5 times their
/// distance.
bool puddle(const LabelledFrame& frame, std::uint32_t i, Random& random, MovedReturn& moved) {
  constexpr double kNearest_m = 6, kFarthest_m = 14, kHalfWidth_m = 2.2;
  const double ahead_m = std::abs(frame.at[i].x());
  if (!frame.ground[i] || ahead_m < kNearest_m || ahead_m > kFarthest_m ||
      std::abs(frame.at[i].y()) > kHalfWidth_m || !random.chance(0.5)) {
    return false;
  }
  moved.range_m = frame.range_m[i] * random.uniform(1.3, 2.5);
  return true;
}

/// Lets three of ten beams end in a cloud of droplets 6 to 14 m ahead, 3 m wide and 1.5 m high.
bool spray(const LabelledFrame& frame, std::uint32_t i, Random& random, MovedReturn& moved) {
  constexpr double kNearest_m = 6, kFarthest_m = 14, kHalfWidth_m = 1.5, kHeight_m = 1.5;
  const Eigen::Vector3d& beam = frame.beam[i];
  if (beam.x() <= 0) return false;
  const double way_m = random.uniform(kNearest_m, kFarthest_m) / beam.x();
  const Eigen::Vector3d at = frame.sensor + way_m * beam;
  if (way_m >= frame.range_m[i] || std::abs(at.y()) > kHalfWidth_m || at.z() > kHeight_m ||
      !random.chance(0.3)) {
    return false;
  }
  moved.range_m = way_m;
  return true;
}

/// Lets a share of the beams end at flakes 2 to 20 m away.
template <int kPercent>
bool snow(const LabelledFrame& frame, std::uint32_t i, Random& random, MovedReturn& moved) {
  constexpr double kNearest_m = 2, kFarthest_m = 20;
  if (frame.range_m[i] <= kNearest_m || !random.chance(kPercent / 100.0)) return false;
  moved.range_m = random.uniform(kNearest_m, std::min(kFarthest_m, frame.range_m[i]));
  return true;
}

/// Removes all returns of a sector of 20 degrees, ahead to the right.
bool dirt(const LabelledFrame& frame, std::uint32_t i, Random&, MovedReturn& moved) {
  constexpr double kFrom_deg = -40, kTo_deg = -20;
  const Eigen::Vector3d& beam = frame.beam[i];
  const double azimuth_deg = std::atan2(beam.y(), beam.x()) * 180 / std::numbers::pi;
  moved.range_m = 0;
  return azimuth_deg >= kFrom_deg && azimuth_deg < kTo_deg;
}

constexpr std::array kDisturbances{
    Disturbance{"ghosts_0.1", ghost<1>}, Disturbance{"ghosts_1", ghost<10>},
    Disturbance{"ghosts_5", ghost<50>},  Disturbance{"puddle", puddle},
    Disturbance{"spray", spray},         Disturbance{"snow_1", snow<1>},
    Disturbance{"snow_10", snow<10>},    Disturbance{"dirt", dirt},
};

}  // namespace

std::span<const Disturbance> disturbances() noexcept {
  return kDisturbances;
}

MovedReturns disturbed(const LabelledFrame& frame, const Disturbance& disturbance,
                       std::uint64_t key) {
  MovedReturns all;
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    world::Random random(world::mix_keys(key, i));
    MovedReturn moved{.index = i};
    if (disturbance.disturb(frame, i, random, moved)) all.push_back(moved);
  }
  return all;
}

}  // namespace terracut::hazards
