// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "shot_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/beams/angle.hpp"

namespace terracut::simulator {
namespace {

using beams::deg_to_rad;

constexpr double kTurn_rad = 2 * std::numbers::pi;

/// Two prisms that turn against each other bend a beam along a rosette.
ShotDirection through_prisms(double time_s, double half_width_deg, double half_height_deg) {
  constexpr double kFirst_hz = 121.57, kSecond_hz = -77.73;
  const double first = kTurn_rad * kFirst_hz * time_s, second = kTurn_rad * kSecond_hz * time_s;
  return {deg_to_rad(half_width_deg / 2 * (std::cos(first) + std::cos(second))),
          deg_to_rad(half_height_deg / 2 * (std::sin(first) + std::sin(second)))};
}

ShotDirection six_beams(std::uint64_t shot, double shots_per_s, double half_width_deg,
                        double half_height_deg, double beams_apart_deg) {
  ShotDirection direction =
      through_prisms(static_cast<double>(shot) / shots_per_s, half_width_deg, half_height_deg);
  direction.elevation_rad += deg_to_rad((static_cast<double>(shot % 6) - 2.5) * beams_apart_deg);
  return direction;
}

constexpr double kPrismShots_per_s = 240'000;

ShotDirection avia(std::uint64_t shot) noexcept {
  return six_beams(shot, kPrismShots_per_s, 35.2, 38.3, 0.12);
}

ShotDirection horizon(std::uint64_t shot) noexcept {
  return six_beams(shot, kPrismShots_per_s, 40.8, 12.0, 0.28);
}

constexpr double kMid360Shots_per_s = 200'000;

/// Returns a position that goes from 0 to 1 and back while `phase` grows by 1.
double back_and_forth(double phase) {
  const double part = phase - std::floor(phase);
  return part < 0.5 ? 2 * part : 2 - 2 * part;
}

ShotDirection mid360(std::uint64_t shot) noexcept {
  constexpr double kHead_hz = 49.37, kNod_hz = 32.41, kLowest_deg = -7, kView_deg = 59;
  const double time_s = static_cast<double>(shot) / kMid360Shots_per_s;
  const auto beam = static_cast<double>(shot % 4);
  return {kTurn_rad * std::fmod(time_s * kHead_hz + beam / 4, 1.0),
          deg_to_rad(kLowest_deg + kView_deg * back_and_forth(time_s * kNod_hz + 0.137 * beam))};
}

ShotDirection mid360_down(std::uint64_t shot) noexcept {
  const ShotDirection up = mid360(shot);
  return {-up.azimuth_rad, -up.elevation_rad};
}

ShotDirection m1(std::uint64_t shot) noexcept {
  constexpr std::uint64_t kShots = 78'750, kFields = 5, kAcross = 126;
  constexpr double kField_deg = 24, kStep_deg = 0.2, kTop_deg = 12.5, kBulge_deg = 0.6;
  const std::uint64_t in_frame = shot % kShots, in_field = in_frame / kFields;
  const std::uint64_t row = in_field / kAcross, step = in_field % kAcross;
  const double across =
      static_cast<double>(row % 2 == 0 ? step : kAcross - 1 - step) / static_cast<double>(kAcross);
  return {deg_to_rad(2.5 * kField_deg -
                     kField_deg * (static_cast<double>(in_frame % kFields) + across)),
          deg_to_rad(kTop_deg - kStep_deg * (static_cast<double>(row) + across) +
                     kBulge_deg * std::sin(across * std::numbers::pi))};
}

constexpr ShotPattern kPatterns[] = {
    {"avia", kPrismShots_per_s, 120, avia},
    {"horizon", kPrismShots_per_s, 120, horizon},
    {"mid360", kMid360Shots_per_s, 70, mid360},
    {"mid360_down", kMid360Shots_per_s, 70, mid360_down},
    {"m1", 787'500, 120, m1},
};

}  // namespace

std::span<const ShotPattern> shot_patterns() noexcept {
  return kPatterns;
}

const ShotPattern* shot_pattern(std::string_view name) noexcept {
  const auto found = std::ranges::find(kPatterns, name, &ShotPattern::name);
  return found == std::end(kPatterns) ? nullptr : &*found;
}

}  // namespace terracut::simulator
