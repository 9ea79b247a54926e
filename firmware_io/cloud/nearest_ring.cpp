// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/nearest_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/beams/angle.hpp"

namespace terracut::cloud {

NearestRing::NearestRing(const scan::RingTable& table) {
  for (const scan::RingLine& ring : table) {
    lines_.push_back({static_cast<float>(std::tan(ring.elevation_rad)),
                      static_cast<float>(ring.vert_offset_m),
                      std::numeric_limits<float>::infinity()});
  }
  constexpr float kDegree = static_cast<float>(beams::deg_to_rad(1.0));
  const std::size_t last = lines_.size() - 1;
  lines_[0].most_off = std::max(kDegree, lines_[0].slope - lines_[1].slope);
  lines_[last].most_off = std::max(kDegree, lines_[last - 1].slope - lines_[last].slope);

  for (int bin = 0; bin <= kBins; ++bin) {
    const double elevation_rad = std::asin(std::clamp(2.0 * bin / kBins - 1, -1.0, 1.0));
    const auto below = std::ranges::find_if(
        table, [&](const scan::RingLine& ring) { return ring.elevation_rad <= elevation_rad; });
    ring_at_.push_back(static_cast<std::int16_t>(
        std::min<std::ptrdiff_t>(below - table.begin(), std::ssize(table) - 1)));
  }
}

std::int16_t NearestRing::operator()(const scan::ScanPoint& point) const noexcept {
  if (!scan::is_place(point)) return scan::kNoRing;
  const float squared_m2 = point.x_m * point.x_m + point.y_m * point.y_m;
  const float distance_m = std::sqrt(squared_m2);
  const float range_m = std::sqrt(squared_m2 + point.z_m * point.z_m);
  if (range_m == 0) return scan::kNoRing;  // so near the origin that its square underflows
  const float position = (point.z_m / range_m + 1) * (0.5F * kBins);
  const auto bin = static_cast<std::size_t>(std::clamp(position, 0.0F, float{kBins}));
  const auto off_m = [&](std::size_t ring) {
    return std::abs(point.z_m - lines_[ring].offset_m - lines_[ring].slope * distance_m);
  };
  auto ring = static_cast<std::size_t>(ring_at_[bin]);
  float off = off_m(ring);
  // Steps to the nearest ring. Ring lines fan out from the sensor, so the distance falls with every
  // step until that ring is reached.
  for (const int step : {-1, 1}) {
    const std::size_t end = step < 0 ? 0 : lines_.size() - 1;
    while (ring != end) {
      const std::size_t next = step < 0 ? ring - 1 : ring + 1;
      const float next_off = off_m(next);
      if (next_off >= off) break;
      ring = next;
      off = next_off;
    }
  }
  if (off > lines_[ring].most_off * range_m) return scan::kNoRing;
  return static_cast<std::int16_t>(ring);
}

}  // namespace terracut::cloud
