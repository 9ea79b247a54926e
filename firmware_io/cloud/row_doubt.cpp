// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/row_doubt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace terracut::cloud {
namespace {

/// The points of one sensor lie within 0.1 to 20 cm of the line of their row. The points of KITTI's
/// scans lie within 27 cm, because they are compensated for the motion of a moving car; KITTI's
/// scans are always of one sensor.
constexpr double kWidestRow_m = 0.3, kWidestOfKitti_m = 0.4;
/// If half of the points lie this close to their line, points far off the line are not from a
/// second sensor.
constexpr double kNoise_m = 0.01;
/// No sensor's beams start higher than this above its origin (an HDL-64E's: up to 0.2 m).
constexpr double kHighestStart_m = 0.5;

double median_start_m(const scan::RingTable& table) {
  std::vector<double> starts;
  for (const scan::RingLine& ring : table) starts.push_back(ring.vert_offset_m);
  if (starts.empty()) return 0;
  const auto middle = starts.begin() + static_cast<std::ptrdiff_t>(starts.size() / 2);
  std::ranges::nth_element(starts, middle);
  return *middle;
}

}  // namespace

std::string doubt_of(const SensorRows& rows) {
  const scan::FittedRings& rings = rows.rings;
  const double widest_m = rows.source == RowSource::kKittiOrder ? kWidestOfKitti_m : kWidestRow_m;
  if (rings.residual.p95_m > widest_m && rings.residual.median_m > kNoise_m) {
    return fmt::format(
        "the points of a laser lie up to {:.2f} m beside its line (95 %), where a sensor's lie "
        "within {:.1f} m: are they of several sensors or revolutions, or not metres in the "
        "sensor's own frame?",
        rings.residual.p95_m, widest_m);
  }
  if (const double start_m = median_start_m(rings.table); std::abs(start_m) > kHighestStart_m) {
    return fmt::format(
        "the beams start {:.2f} m {} the origin: are these points in a vehicle's frame instead of "
        "the sensor's own?",
        std::abs(start_m), start_m > 0 ? "above" : "below");
  }
  return {};
}

}  // namespace terracut::cloud
