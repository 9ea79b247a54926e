// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/laser_order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "firmware_io/scan/ring_table.hpp"

namespace terracut::cloud {

using scan::kNoRing;
using scan::ScanPoint;

void LaserElevations::add(std::span<const ScanPoint> points,
                          std::span<const std::uint16_t> laser_of_point) {
  constexpr std::size_t kEvery = 7;  // every 7th point of a laser is enough for a median
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ScanPoint& point = points[i];
    const std::size_t laser = laser_of_point[i];
    if (!scan::is_place(point) || seen_[laser]++ % kEvery != 0) continue;
    const double distance_m = std::hypot(double{point.x_m}, double{point.y_m});
    samples_[laser].push_back({distance_m, std::atan2(double{point.z_m}, distance_m)});
  }
}

RingOfLaser LaserElevations::order() {
  std::vector<double> elevation_rad(samples_.size());
  std::vector<std::size_t> lasers;
  for (std::size_t laser = 0; laser < samples_.size(); ++laser) {
    if (samples_[laser].empty()) continue;
    elevation_rad[laser] = typical_elevation_rad(samples_[laser]);
    lasers.push_back(laser);
  }
  std::ranges::sort(lasers, [&](std::size_t a, std::size_t b) {
    return elevation_rad[a] != elevation_rad[b] ? elevation_rad[a] > elevation_rad[b] : a < b;
  });
  // If laser numbers ascend or descend with elevation, lasers without points get a ring, too.
  const bool goes_down = std::ranges::is_sorted(lasers),
             goes_up = std::ranges::is_sorted(lasers, std::greater{});
  if (goes_down || goes_up) {
    lasers.resize(samples_.size());
    std::iota(lasers.begin(), lasers.end(), std::size_t{0});
    if (!goes_down) std::ranges::reverse(lasers);
  }
  RingOfLaser ring_of_laser(samples_.size(), kNoRing);
  for (std::size_t ring = 0; ring < lasers.size(); ++ring) {
    ring_of_laser[lasers[ring]] = static_cast<std::int16_t>(ring);
  }
  return ring_of_laser;
}

// Returns the median over the farther half of the samples, where it matters least that a beam
// starts beside the origin.
double LaserElevations::typical_elevation_rad(std::vector<Sample>& samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::ranges::nth_element(samples, middle, {}, &Sample::distance_m);
  const auto far_middle = middle + (samples.end() - middle) / 2;
  std::ranges::nth_element(middle, far_middle, samples.end(), {}, &Sample::elevation_rad);
  return far_middle->elevation_rad;
}

}  // namespace terracut::cloud
