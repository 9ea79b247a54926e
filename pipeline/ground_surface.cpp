// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground_surface.hpp"

#include <algorithm>

namespace terracut::pipeline {

GroundSurface::GroundSurface(const Config& config, const RingGrid& grid, rt::FixedMemory& memory)
    : config_(config),
      walked_m_(memory.take<float>("ground surface", grid.cells())),
      height_m_(memory.take<float>("ground surface", grid.cells())),
      measured_(memory.take<std::uint8_t>("ground surface", grid.cells())) {}

void GroundSurface::estimate(const RingGrid& grid, std::span<const float> lowest_m) noexcept {
  for (int sector = 0; sector < grid.sectors(); ++sector) walk_outwards(grid, sector, lowest_m);
  borrow_from_neighbours(grid);
}

void GroundSurface::walk_outwards(const RingGrid& grid, int sector,
                                  std::span<const float> lowest_m) noexcept {
  float last_m = 0;        // the walk starts on the mount's plane, under the sensor
  float last_range_m = 0;
  float slope = 0;
  for (int band = 0; band < grid.bands(); ++band) {
    const std::size_t cell = grid.cell(sector, band);
    const float run_m = grid.center_m(band) - last_range_m;
    const float predicted_m = last_m + slope * std::min(run_m, config_.slope_memory_m);
    const float rise_m = lowest_m[cell] - predicted_m;
    const float accepted_rise_m = std::min(config_.step_up_m + config_.slope_tolerance * run_m,
                                           config_.step_up_limit_m);
    const bool is_ground =
        rise_m < accepted_rise_m && rise_m > -(accepted_rise_m + config_.extra_fall * run_m);
    measured_[cell] = is_ground ? 1 : 0;
    if (!is_ground) {
      walked_m_[cell] = predicted_m;
      continue;
    }
    const float step_slope =
        (lowest_m[cell] - last_m) / std::max(run_m, config_.first_slope_run_m);
    slope = std::clamp((1.0F - config_.slope_gain) * slope + config_.slope_gain * step_slope,
                       -config_.max_slope, config_.max_slope);
    last_m = walked_m_[cell] = lowest_m[cell];
    last_range_m = grid.center_m(band);
  }
}

void GroundSurface::borrow_from_neighbours(const RingGrid& grid) noexcept {
  const int sectors = grid.sectors();
  const int reach = std::min(config_.borrow_sectors, (sectors - 1) / 2);
  for (int sector = 0; sector < sectors; ++sector) {
    for (int band = 0; band < grid.bands(); ++band) {
      const std::size_t cell = grid.cell(sector, band);
      float sum_m = walked_m_[cell];
      if (measured_[cell] == 0) {
        float weights = config_.walked_weight;
        sum_m *= weights;
        for (int distance = 1; distance <= reach; ++distance) {
          const float weight = 1.0F / static_cast<float>(distance);
          const int left = sector >= distance ? sector - distance : sector - distance + sectors;
          const int right = sector + distance < sectors ? sector + distance : sector + distance - sectors;
          for (const int neighbour : {left, right}) {
            const std::size_t lender = grid.cell(neighbour, band);
            if (measured_[lender] == 0) continue;
            sum_m += weight * walked_m_[lender];
            weights += weight;
          }
        }
        sum_m /= weights;
      }
      height_m_[cell] = sum_m;
    }
  }
}

}  // namespace terracut::pipeline
