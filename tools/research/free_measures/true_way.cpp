// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "true_way.hpp"

#include <limits>

#include "firmware_io/scan/kitti_scan.hpp"
#include "tools/research/statistics/true_ground.hpp"

namespace terracut::free_measures {

std::size_t sector_of(const free_way::FreeWay& free_way, int column) {
  std::size_t first = 0, last = free_way.sectors().size();
  while (last - first > 1) {
    const std::size_t middle = (first + last) / 2;
    (free_way.columns_of(middle).begin <= column ? first : last) = middle;
  }
  return first;
}

std::vector<float> true_obstacles_m(const hazards::LabelledFrame& frame,
                                    const datasets::ClassTable& classes,
                                    const free_way::FreeWay& free_way,
                                    const free_way::FreeWay::Config& config) {
  scan::KittiScan scan;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const auto at = frame.at[i].cast<float>();
    scan.points.push_back({at.x(), at.y(), at.z(), 0});
    scan.labels.push_back(frame.class_id[i]);
  }
  statistics::TrueGround ground(classes);
  ground.look_at(scan);
  std::vector<float> nearest_m(free_way.sectors().size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (frame.role[i] == datasets::Role::kGround || frame.role[i] == datasets::Role::kIgnored) {
      continue;
    }
    float& nearest = nearest_m[sector_of(free_way, frame.cell[i].column)];
    const auto range_m = static_cast<float>(frame.at[i].head<2>().norm());
    if (range_m >= nearest) continue;
    const auto ground_m = ground.height_m(frame.at[i].x(), frame.at[i].y());
    if (!ground_m) continue;
    const double height_m = frame.at[i].z() - *ground_m;
    if (height_m < config.least_height_m || height_m > config.clearance_m) continue;
    nearest = range_m;
  }
  return nearest_m;
}

}  // namespace terracut::free_measures
