// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace terracut::simulator {

/// The direction of a shot in the sensor frame.
struct ShotDirection {
  double azimuth_rad = 0;    ///< From x ahead to y left.
  double elevation_rad = 0;  ///< Up positive.
};

/// The scan pattern of a sensor without rows: where each shot of an endless sequence goes. Patterns
/// have the field of view, the rate and the way of scanning that makers publish; they are like
/// these sensors, not copies of them.
struct ShotPattern {
  std::string_view name;
  double shots_per_s = 0;
  double max_range_m = 0;
  ShotDirection (*direction)(std::uint64_t shot) noexcept = nullptr;
};

/// Returns the patterns: "avia" and "horizon" (two turning prisms, six beams, ahead), "mid360" (all
/// around, mostly upwards), "mid360_down" (the same hung upside down, in its own upright frame) and
/// "m1" (a mirror that swings, five fields side by side; the only one that repeats).
[[nodiscard]] std::span<const ShotPattern> shot_patterns() noexcept;

/// Returns the pattern of this name; nullptr if there is none.
[[nodiscard]] const ShotPattern* shot_pattern(std::string_view name) noexcept;

}  // namespace terracut::simulator
