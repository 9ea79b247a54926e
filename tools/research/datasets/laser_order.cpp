// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "laser_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware_io/scan/ring_table.hpp"

namespace terracut::datasets {

using scan::kNoRing;
using scan::RingRecovery;
using scan::ScanPoint;

void find_rings(const RingOfLaser& ring_of_laser, LabelledScan& scan) {
  RingRecovery& rings = scan.rings;
  std::vector<bool> met(ring_of_laser.size());
  rings = {.ring_of_point = std::move(rings.ring_of_point)};
  rings.ring_of_point.resize(scan.scan.points.size());
  for (std::size_t i = 0; i < scan.scan.points.size(); ++i) {
    const auto laser = static_cast<std::size_t>(scan.laser_of_point[i]);
    const std::int16_t ring = is_place(scan.scan.points[i]) ? ring_of_laser[laser] : kNoRing;
    rings.ring_of_point[i] = ring;
    if (ring == kNoRing) {
      ++rings.no_ring;
    } else {
      met[laser] = true;
    }
  }
  rings.rings = static_cast<int>(std::ranges::count(met, true));
}

void LaserElevations::add(const LabelledScan& scan) {
  constexpr std::size_t kEvery = 7;  // Of the points of each laser: enough for a median.
  for (std::size_t i = 0; i < scan.scan.points.size(); ++i) {
    const ScanPoint& point = scan.scan.points[i];
    const auto laser = static_cast<std::size_t>(scan.laser_of_point[i]);
    if (!is_place(point) || seen_[laser]++ % kEvery != 0) continue;
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
  RingOfLaser ring_of_laser(samples_.size(), kNoRing);
  for (std::size_t ring = 0; ring < lasers.size(); ++ring) {
    ring_of_laser[lasers[ring]] = static_cast<std::int16_t>(ring);
  }
  return ring_of_laser;
}

// The median over the farther half: lasers do not start at the origin, which matters least far
// away.
double LaserElevations::typical_elevation_rad(std::vector<Sample>& samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::ranges::nth_element(samples, middle, {}, &Sample::distance_m);
  const auto far_middle = middle + (samples.end() - middle) / 2;
  std::ranges::nth_element(middle, far_middle, samples.end(), {}, &Sample::elevation_rad);
  return far_middle->elevation_rad;
}

}  // namespace terracut::datasets
