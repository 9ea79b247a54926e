// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace terracut::pipeline {

GroundSurface::GroundSurface(const Config& config, const RingGrid& grid, rt::FixedMemory& memory)
    : config_(config),
      walked_m_(memory.take<float>("ground surface", grid.cells())),
      height_m_(memory.take<float>("ground surface", grid.cells())),
      origin_(memory.take<Origin>("ground surface", grid.cells())) {}

void GroundSurface::estimate(const RingGrid& grid, std::span<const LowestReturn> lowest) noexcept {
  for (int sector = 0; sector < grid.sectors(); ++sector) walk_outwards(grid, sector, lowest);
  drop_narrow_strips(grid);
  borrow_from_neighbours(grid, lowest);
}

float GroundSurface::Walk::predict_m(float to_range_m, const Config& config) const noexcept {
  return height_m + slope * std::min(to_range_m - range_m, config.slope_memory_m);
}

bool GroundSurface::Walk::reaches(float to_range_m, float to_height_m,
                                  const Config& config) const noexcept {
  const float run_m = to_range_m - range_m;
  const float rise_m = to_height_m - predict_m(to_range_m, config);
  const float accepted_m =
      std::min(config.step_up_m + config.slope_tolerance * run_m, config.step_up_limit_m);
  return rise_m < accepted_m && rise_m > -(accepted_m + config.extra_fall * run_m);
}

float GroundSurface::Walk::step(float to_range_m, float to_height_m,
                                const Config& config) noexcept {
  const float run_m = std::max(to_range_m - range_m, config.first_slope_run_m);
  const float step_slope =
      std::clamp((to_height_m - height_m) / run_m, -config.max_slope, config.max_slope);
  slope = std::clamp((1.0F - config.slope_gain) * slope + config.slope_gain * step_slope,
                     -config.max_slope, config.max_slope);
  height_m = to_height_m;
  range_m = to_range_m;
  return step_slope;
}

void GroundSurface::walk_outwards(const RingGrid& grid, int sector,
                                  std::span<const LowestReturn> lowest) noexcept {
  Walk ground;
  int lost_band = walk_on(grid, sector, 0, kMeasured, ground, lowest);
  for (;;) {
    const Detour detour = find_ground_again(grid, sector, lost_band, ground, lowest);
    if (detour.band < 0) return;
    const LowestReturn& start = lowest[grid.cell(sector, detour.band)];
    ground = {start.height_m, start.range_m, detour.slope};
    lost_band =
        std::max(detour.band, walk_on(grid, sector, detour.band, kRegained, ground, lowest));
  }
}

int GroundSurface::walk_on(const RingGrid& grid, int sector, int band, Origin origin, Walk& ground,
                           std::span<const LowestReturn> lowest) noexcept {
  int last_band = -1;
  for (; band < grid.bands(); ++band) {
    const std::size_t cell = grid.cell(sector, band);
    const float center_m = grid.center_m(band);
    const LowestReturn& here = lowest[cell];
    const bool is_ground =
        here.height_m != kEmpty && ground.reaches(here.range_m, here.height_m, config_);
    origin_[cell] = is_ground ? origin : kPredicted;
    if (is_ground) {
      // The step's own slope carries the heights of both returns to the middles of their cells.
      const Walk before = ground;
      const float step_slope = ground.step(here.range_m, here.height_m, config_);
      if (last_band >= 0 && grid.center_m(last_band) > before.range_m) {
        walked_m_[grid.cell(sector, last_band)] =
            before.height_m + step_slope * (grid.center_m(last_band) - before.range_m);
      }
      walked_m_[cell] = center_m < here.range_m
                            ? here.height_m - step_slope * (here.range_m - center_m)
                            : ground.predict_m(center_m, config_);
      last_band = band;
    } else {
      walked_m_[cell] = ground.predict_m(center_m, config_);
    }
  }
  return last_band;
}

GroundSurface::Detour GroundSurface::find_ground_again(
    const RingGrid& grid, int sector, int lost_band, const Walk& ground,
    std::span<const LowestReturn> lowest) const noexcept {
  // No steeper than regain_slope from one place to the next.
  const auto passable = [this](const LowestReturn& from, const LowestReturn& to) {
    return std::fabs(to.height_m - from.height_m) <=
           config_.regain_slope * (to.range_m - from.range_m);
  };
  const LowestReturn lost{ground.height_m, ground.range_m};
  LowestReturn start, last;
  int start_band = -1;     // of the places that lead on passably from one to the next
  bool connected = false;  // ... and whether they do so from the lost ground
  for (int band = lost_band + 1; band < grid.bands(); ++band) {
    const LowestReturn& here = lowest[grid.cell(sector, band)];
    if (here.height_m == kEmpty) continue;
    if (start_band < 0 || !passable(last, here)) {
      start = here;
      start_band = band;
      connected = passable(lost, here);
    }
    last = here;
    const float length_m = here.range_m - start.range_m;
    if (connected && length_m >= config_.regain_length_m) {
      return {start_band, std::clamp((here.height_m - start.height_m) / length_m,
                                     -config_.max_slope, config_.max_slope)};
    }
  }
  return {};
}

void GroundSurface::drop_narrow_strips(const RingGrid& grid) noexcept {
  const float sector_rad = 2 * std::numbers::pi_v<float> / static_cast<float>(grid.sectors());
  for (int band = 0; band < grid.bands(); ++band) {
    const float sector_width_m = sector_rad * grid.center_m(band);
    const int needed = static_cast<int>(config_.regain_width_m / sector_width_m);
    // Runs of regained cells along the band, around the circle; ground to either side counts too.
    const auto origin = [&](int sector) -> Origin& {
      return origin_[grid.cell(sector % grid.sectors(), band)];
    };
    int first = 0;
    while (first < grid.sectors() && origin(first) != kPredicted) ++first;
    if (first == grid.sectors()) continue;
    for (int sector = first; sector < first + grid.sectors(); ++sector) {
      int length = 0;
      while (origin(sector + length) != kPredicted) ++length;
      for (int i = 0; i < length && length < needed; ++i) {
        if (origin(sector + i) == kRegained) origin(sector + i) = kPredicted;
      }
      sector += length;
    }
  }
}

void GroundSurface::borrow_from_neighbours(const RingGrid& grid,
                                           std::span<const LowestReturn> lowest) noexcept {
  const int bands = grid.bands();
  for (int sector = 0; sector < grid.sectors(); ++sector) {
    const std::size_t first = grid.cell(sector, 0);
    const auto has_return = [&](int band) {
      return band >= 0 && band < bands &&
             lowest[first + static_cast<std::size_t>(band)].height_m != kEmpty;
    };
    for (int band = 0; band < bands; ++band) {
      const std::size_t cell = first + static_cast<std::size_t>(band);
      // Heights are asked for where returns are, and between bands only from one to the next.
      const bool is_asked_for = has_return(band - 1) || has_return(band) || has_return(band + 1);
      height_m_[cell] = origin_[cell] == kPredicted && is_asked_for ? borrowed_m(grid, sector, band)
                                                                    : walked_m_[cell];
    }
  }
}

float GroundSurface::borrowed_m(const RingGrid& grid, int sector, int band) const noexcept {
  const int sectors = grid.sectors();
  const int reach = std::min(config_.borrow_sectors, (sectors - 1) / 2);
  float weights = config_.walked_weight;
  float sum_m = weights * walked_m_[grid.cell(sector, band)];
  for (int distance = 1; distance <= reach; ++distance) {
    const float weight = 1.0F / static_cast<float>(distance);
    const int left = sector >= distance ? sector - distance : sector - distance + sectors;
    const int right = sector + distance < sectors ? sector + distance : sector + distance - sectors;
    for (const int neighbour : {left, right}) {
      const std::size_t lender = grid.cell(neighbour, band);
      if (origin_[lender] == kPredicted) continue;
      sum_m += weight * walked_m_[lender];
      weights += weight;
    }
  }
  return sum_m / weights;
}

}  // namespace terracut::pipeline
