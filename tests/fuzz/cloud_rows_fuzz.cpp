// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Clouds of a sensor with 8 to 72 lasers whose points were then moved, scaled, taken away,
// exchanged or overwritten with any bytes; with the lasers' numbers, organised or neither. The
// outcome is an error in words, or rows from the highest down that look nowhere beyond straight up
// and down, and a row of them or none for each point.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "firmware_io/cloud/elevation_bins.hpp"
#include "firmware_io/cloud/row_doubt.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "input.hpp"

namespace {

using namespace terracut;

constexpr int kColumns = 40;

struct MadeCloud {
  std::vector<scan::ScanPoint> points;
  std::vector<std::uint16_t> laser;
  std::size_t rows = 1;

  [[nodiscard]] cloud::CloudView view() const { return {points, laser, rows}; }
};

/// Lasers one step apart above level ground, with walls around.
MadeCloud cloud_from(fuzz::Input& input) {
  MadeCloud cloud;
  const int lasers = 8 + input.below(65);
  const double top_rad = input.below(90) * 0.017, step_rad = 0.002 + input.below(40) * 0.001;
  const double height_m = 0.3 + input.below(20) * 0.1;
  for (int laser = 0; laser < lasers; ++laser) {
    const double slope = std::tan(std::max(top_rad - laser * step_rad, -1.5));
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = column * 6.2831853 / kColumns, wall_m = 5 + column % 7 * 4;
      const double distance_m = slope < 0 ? std::min(wall_m, height_m / -slope) : wall_m;
      cloud.points.push_back({static_cast<float>(distance_m * std::cos(azimuth)),
                              static_cast<float>(distance_m * std::sin(azimuth)),
                              static_cast<float>(distance_m * slope), 0});
      cloud.laser.push_back(static_cast<std::uint16_t>(laser));
    }
  }
  const int told_by = input.below(3);
  if (told_by != 0) cloud.laser.clear();
  if (told_by == 1) cloud.rows = static_cast<std::size_t>(lasers);
  return cloud;
}

void bend(fuzz::Input& input, MadeCloud& cloud) {
  const std::size_t first = input.next(2) % cloud.points.size();
  const std::size_t count = std::min<std::size_t>(input.next(2), cloud.points.size() - first);
  const auto what = input.below(6);
  const auto amount = static_cast<float>(input.below(256) - 128) * (input.below(2) ? 10.0F : 0.02F);
  const auto bytes = std::bit_cast<float>(input.next(4));
  for (std::size_t i = first; i < first + count; ++i) {
    scan::ScanPoint& p = cloud.points[i];
    const std::size_t other = (i * 7919 + first) % cloud.points.size();
    if (what == 0) p.x_m += amount;
    if (what == 1) p.z_m += amount;
    if (what == 2) p = {p.x_m * amount, p.y_m * amount, p.z_m * amount, 0};
    if (what == 3) p.y_m = bytes;
    if (what == 4) p = {};
    if (what == 5) std::swap(p, cloud.points[other]);
    if (!cloud.laser.empty() && what == 5)
      cloud.laser[i] = static_cast<std::uint16_t>(input.next(1));
  }
}

void check_rows(const cloud::SensorRows& rows) {
  const scan::RingTable& table = rows.rings.table;
  fuzz::require(table.size() >= 2 && table.size() <= cloud::kMostLasers, "so many rows has none");
  for (std::size_t i = 0; i < table.size(); ++i) {
    fuzz::require(std::abs(table[i].elevation_rad) < 1.58, "a row looks nowhere");
    fuzz::require(i == 0 || table[i].elevation_rad < table[i - 1].elevation_rad,
                  "not from the top");
  }
  fuzz::require(rows.columns > 0, "no columns");
  (void)cloud::doubt_of(rows);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  std::vector<MadeCloud> clouds{cloud_from(input)};
  while (!input.empty() && clouds.size() < 3) {
    bend(input, clouds.back());
    if (input.below(4) == 0) clouds.push_back(clouds.front());
  }
  const auto rows = cloud::learn_rows_or_bins(
      clouds.size(), [&](std::size_t i) -> Expected<cloud::CloudView> { return clouds[i].view(); });
  if (!rows) {
    fuzz::require(!rows.error().message.empty(), "an error without words");
    return 0;
  }
  check_rows(*rows);
  const cloud::RowFinder finder(*rows);
  scan::RingRecovery found;
  for (const MadeCloud& cloud : clouds) {
    if (!finder.find(cloud.view(), found)) continue;
    fuzz::require(found.ring_of_point.size() == cloud.points.size(), "not a row for each point");
    for (const std::int16_t ring : found.ring_of_point) {
      const bool is_row = ring >= 0 && static_cast<std::size_t>(ring) < rows->rings.table.size();
      fuzz::require(is_row || ring == scan::kNoRing, "a row that is none");
    }
  }
  return 0;
}
