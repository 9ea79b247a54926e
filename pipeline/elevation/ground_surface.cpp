// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/ground_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <utility>

#include "pipeline/stage/float_lanes.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

constexpr auto kMostBands = static_cast<std::size_t>(RingGrid::kMaxBands);
constexpr int kMostSectorsBehind = 100;  ///< Of Config::interpolate_sectors.

/// Marks the bands of a sector whose height is needed but was not measured. Heights are needed in
/// bands with a return and, for interpolation, in those next to them.
TERRACUT_VECTOR_CLONES void find_missing(const GroundSurface::LowestReturn* __restrict lowest,
                                         const std::uint8_t* __restrict origin, std::size_t bands,
                                         std::uint8_t* __restrict is_missing) noexcept {
  std::uint8_t has_return[kMostBands + 2];  // by band, with one more at either end
  has_return[0] = has_return[bands + 1] = 0;
  for (std::size_t i = 0; i < bands; ++i) {
    has_return[i + 1] = lowest[i].height_m != GroundSurface::kEmpty;
  }
  for (std::size_t i = 0; i < bands; ++i) {
    const auto is_asked_for =
        static_cast<std::uint8_t>(has_return[i] | has_return[i + 1] | has_return[i + 2]);
    is_missing[i] = static_cast<std::uint8_t>(is_asked_for & (origin[i] == 0 ? 1 : 0));
  }
}

/// What tracing the ground outwards found in a sector's cells: heights of the ground, and where
/// each height is from.
struct FoundInSector {
  const float* traced_m;
  const std::uint8_t* origin;
  const GroundSurface::LowestReturn* lowest;
};

/// Finds how far the ground of a sector rises from its first edge to its last, if it and both
/// neighbours have ground of their own. This is the central difference, limited to twice the
/// difference to either neighbour, and 0 on a crest or in a dip (the monotonised central limiter;
/// van Leer, J. Comput. Phys. 23, 1977). So a kerb between two sectors tilts neither.
TERRACUT_VECTOR_CLONES void find_rises(const FoundInSector& before, const FoundInSector& here,
                                       const FoundInSector& after, float tall_m,
                                       const float* __restrict max_rise_m, std::size_t bands,
                                       float* __restrict rise_m) noexcept {
  const auto less = [](float a, float b) { return a < b ? a : b; };
  const auto greater = [](float a, float b) { return a > b ? a : b; };
  const auto height_of = [](const GroundSurface::LowestReturn& cell) {
    return cell.highest_m - cell.height_m;
  };
  // The loops have no branch, so that the compiler vectorises them.
  std::int32_t may_rise[kMostBands];
  float tallest_m[kMostBands];
  for (std::size_t i = 0; i < bands; ++i) {
    const float beside_m = greater(height_of(before.lowest[i]), height_of(after.lowest[i]));
    tallest_m[i] = greater(height_of(here.lowest[i]), beside_m);
    may_rise[i] = before.origin[i] * here.origin[i] * after.origin[i];
  }
  for (std::size_t i = 0; i < bands; ++i) {
    const float from_before_m = here.traced_m[i] - before.traced_m[i];
    const float to_after_m = after.traced_m[i] - here.traced_m[i];
    const float central_m = 0.5F * (from_before_m + to_after_m);
    const float twice_either_m = 2 * less(std::fabs(from_before_m), std::fabs(to_after_m));
    const float most_m = less(less(std::fabs(central_m), twice_either_m), max_rise_m[i]);
    const std::int32_t rises = (may_rise[i] != 0 ? 1 : 0) &
                               (tallest_m[i] <= tall_m + most_m ? 1 : 0) &
                               (from_before_m * to_after_m > 0 ? 1 : 0);
    rise_m[i] = static_cast<float>(rises) * std::copysign(most_m, central_m);
  }
}

using stage::EightFloats, stage::EightInts, stage::kEight;

/// A sector that lends heights to another, and how much they count; arrays by band.
struct Donor {
  const float* traced_m;
  const std::uint8_t* origin;  // 0 where nothing was measured
  float weight;
};

/// Replaces eight heights by the weighted means of what was measured in the bands of `donors` from
/// `band` on; heights that nobody measured stay.
TERRACUT_VECTOR_CLONES_OF_INLINED void mix_eight(std::span<const Donor> donors, std::size_t band,
                                                 float* height_m) noexcept {
  EightFloats sum_m{}, weights{};
  for (const Donor& donor : donors) {
    EightFloats traced_m;
    std::uint8_t __attribute__((vector_size(8))) origin;
    std::memcpy(&traced_m, donor.traced_m + band, sizeof(traced_m));
    std::memcpy(&origin, donor.origin + band, sizeof(origin));
    const EightInts is_measured = __builtin_convertvector(origin, EightInts) != 0;
    const EightFloats weight = is_measured ? donor.weight - EightFloats{} : EightFloats{};
    sum_m += weight * traced_m;
    weights += weight;
  }
  EightFloats before_m;
  std::memcpy(&before_m, height_m, sizeof(before_m));
  const EightFloats mixed_m = weights > 0 ? sum_m / weights : before_m;
  std::memcpy(height_m, &mixed_m, sizeof(mixed_m));
}

}  // namespace

GroundSurface::GroundSurface(const Config& config, float obstacle_height_m, const RingGrid& grid,
                             memory::FixedMemory& memory)
    : config_(config),
      foot_rise_m_(obstacle_height_m),
      deep_m_(grid.deepest_band_m()),
      behind_(std::min({config.interpolate_sectors, kMostSectorsBehind, (grid.sectors() - 1) / 2})),
      ahead_(std::min({config.sectors_ahead, config.interpolate_sectors, behind_})),
      traced_m_(memory.take<float>("ground surface", grid.cells() + kEight)),
      heights_(memory.take<EdgeHeights>("ground surface", grid.cells() + 1)),
      found_(memory.take<Origin>("ground surface", grid.cells())),
      origin_(memory.take<Origin>("ground surface", grid.cells() + kEight)),
      has_regained_(
          memory.take<std::uint8_t>("ground surface", static_cast<std::size_t>(grid.sectors()))),
      wide_from_(
          memory.take<std::int32_t>("ground surface", static_cast<std::size_t>(grid.bands()))),
      max_rise_m_(memory.take<float>("ground surface", wide_from_.size())) {
  const float sector_rad = 2 * std::numbers::pi_v<float> / static_cast<float>(grid.sectors());
  for (int band = 0; band < grid.bands(); ++band) {
    const auto i = static_cast<std::size_t>(band);
    const float sector_m = sector_rad * grid.center_m(band);
    const float sectors_wide = config.regain_length_m / sector_m;
    constexpr float kMostSectors = 16;
    wide_from_[i] = static_cast<std::int32_t>(
        std::min({sectors_wide, kMostSectors, static_cast<float>(grid.sectors())}));
    max_rise_m_[i] = config.max_slope * sector_m;
  }
}

inline bool GroundSurface::leads_to(const RingGrid& grid, const Ground& ground, int band,
                                    const LowestReturn& here) const noexcept {
  if (here.height_m == kEmpty || here.is_no_ground != 0) return false;
  const bool is_first = ground.range_m == 0;
  if (is_first && !may_start_at(here)) return false;
  const float run_m = here.range_m - ground.range_m;
  const float rise_m = here.height_m - ground.height_m;
  const float unseen_m = is_first ? 0 : std::min(run_m, grid.unseen_m(band));
  const float accepted_m = std::min(config_.step_up_m + config_.slope_tolerance * run_m,
                                    config_.step_up_limit_m + config_.far_slope * unseen_m);
  if (rise_m >= accepted_m || rise_m <= -(accepted_m + config_.extra_fall * run_m)) return false;
  return rise_m <= foot_rise_m_ || here.highest_m - here.height_m <= config_.tall_m;
}

inline bool GroundSurface::is_passable(const LowestReturn& from,
                                       const LowestReturn& to) const noexcept {
  const float run_m = to.range_m - from.range_m;
  return std::fabs(to.height_m - from.height_m) <=
         config_.max_slope * std::min(run_m, deep_m_) +
             config_.far_slope * std::max(run_m - deep_m_, 0.0F);
}

inline float GroundSurface::slope_of(float rise_m, float run_m) const noexcept {
  constexpr float kShortestRun_m = 0.4F;  // over less the noise of two heights makes the slope
  return std::clamp(rise_m / std::max(run_m, kShortestRun_m), -config_.max_slope,
                    config_.max_slope);
}

void GroundSurface::trace(const RingGrid& grid, int sector,
                          std::span<const LowestReturn> lowest) noexcept {
  sector = grid.wrapped(sector);
  Ground ground;
  has_regained_[static_cast<std::size_t>(sector)] = 0;
  int lost_band = trace_on(grid, sector, 0, kMeasured, ground, lowest);
  for (;;) {
    const Detour detour = find_ground_again(grid, sector, lost_band, grid.bands(), ground, lowest);
    if (detour.band < 0) return;
    has_regained_[static_cast<std::size_t>(sector)] = 1;
    const LowestReturn& start = lowest[grid.cell(sector, detour.band)];
    ground = {start.height_m, start.range_m, detour.slope};
    lost_band =
        std::max(detour.band, trace_on(grid, sector, detour.band, kRegained, ground, lowest));
  }
}

int GroundSurface::trace_on(const RingGrid& grid, int sector, int band, Origin origin,
                            Ground& ground, std::span<const LowestReturn> lowest) noexcept {
  int last_band = -1;
  for (; band < grid.bands(); ++band) {
    const std::size_t cell = grid.cell(sector, band);
    const float center_m = grid.center_m(band);
    const LowestReturn& here = lowest[cell];
    const bool is_ground = leads_to(grid, ground, band, here);
    // Ground goes on here, but far behind where it was lost: a bank in between takes precedence.
    if (is_ground && here.range_m - ground.range_m > config_.regain_length_m &&
        find_ground_again(grid, sector, last_band, band, ground, lowest).band >= 0) {
      break;
    }
    found_[cell] = is_ground ? origin : kPredicted;
    if (is_ground) {
      // The step's slope carries the heights of both returns to the middles of their cells.
      const Ground before = std::exchange(ground, Ground{here.height_m, here.range_m});
      const float run_m = here.range_m - before.range_m;
      const float slope =
          run_m > 0 ? slope_of(here.height_m - before.height_m, run_m) : before.slope;
      if (last_band >= 0 && grid.center_m(last_band) > before.range_m) {
        traced_m_[grid.cell(sector, last_band)] =
            before.height_m + slope * (grid.center_m(last_band) - before.range_m);
      }
      const float to_middle_m = center_m - here.range_m;
      traced_m_[cell] =
          here.height_m + slope * (run_m > 0 ? std::min(to_middle_m, 0.0F) : to_middle_m);
      last_band = band;
    } else {
      traced_m_[cell] = ground.height_m;
    }
  }
  return last_band;
}

GroundSurface::Detour GroundSurface::find_ground_again(
    const RingGrid& grid, int sector, int lost_band, int end_band, const Ground& ground,
    std::span<const LowestReturn> lowest) const noexcept {
  const LowestReturn lost{ground.height_m, ground.range_m};
  LowestReturn start, last;
  int start_band = -1;     // start of the passable run
  bool connected = false;  // true if the run is passable from the lost ground
  for (int band = lost_band + 1; band < end_band; ++band) {
    const LowestReturn& here = lowest[grid.cell(sector, band)];
    if (here.height_m == kEmpty || here.is_no_ground != 0) continue;
    const bool leads_on = is_passable(last, here) &&
                          (connected || here.range_m - last.range_m <= config_.regain_length_m);
    if (start_band < 0 || !leads_on) {
      start = here;
      start_band = band;
      connected = is_passable(lost, here) && (lost.range_m != 0 || may_start_at(here));
    }
    last = here;
    const float length_m = here.range_m - start.range_m;
    if (connected && length_m >= config_.regain_length_m) {
      return {start_band, slope_of(here.height_m - start.height_m, length_m)};
    }
  }
  return {};
}

void GroundSurface::find_donors(const RingGrid& grid, int sector) noexcept {
  sector = grid.wrapped(sector);
  const std::span<const Origin> found = of_sector(found_, grid, sector);
  const std::span<Origin> origin = of_sector(origin_, grid, sector);
  std::memcpy(origin.data(), found.data(), found.size_bytes());
  if (has_regained_[static_cast<std::size_t>(sector)] == 0) return;
  for (int band = 0; band < grid.bands(); ++band) {
    Origin& own = origin[static_cast<std::size_t>(band)];
    if (own == kRegained && !lies_on_wide_strip(grid, sector, band)) own = kPredicted;
  }
}

bool GroundSurface::lies_on_wide_strip(const RingGrid& grid, int sector, int band) const noexcept {
  // Walks along the band around the circle; ground of any origin counts.
  const int wide_from = wide_from_[static_cast<std::size_t>(band)];
  const auto is_ground = [&](int s) {
    return found_[grid.cell(grid.wrapped(s), band)] != kPredicted;
  };
  int first = sector, end = sector + 1;
  while (end - first < wide_from && end - sector <= kStripAhead && is_ground(end)) ++end;
  while (end - first < wide_from && sector - first < kStripBehind && is_ground(first - 1)) --first;
  return end - first >= wide_from;
}

void GroundSurface::estimate(const RingGrid& grid, int sector,
                             std::span<const LowestReturn> lowest) noexcept {
  static_assert(sizeof(Origin) == 1 && kPredicted == 0);
  sector = grid.wrapped(sector);
  const auto bands = static_cast<std::size_t>(grid.bands());
  const auto found_in = [&](int s) {
    const std::size_t first = grid.cell(grid.wrapped(s), 0);
    return FoundInSector{&traced_m_[first], reinterpret_cast<const std::uint8_t*>(&origin_[first]),
                         &lowest[first]};
  };
  const FoundInSector here = found_in(sector);
  std::array<std::uint8_t, kMostBands + kEight> is_missing{};
  find_missing(here.lowest, here.origin, bands, is_missing.data());
  std::array<float, kMostBands + kEight> lower_m;
  std::copy_n(here.traced_m, bands, lower_m.begin());
  interpolate(grid, sector, is_missing, lower_m);
  std::array<float, kMostBands> rise_m;
  find_rises(found_in(sector - 1), here, found_in(sector + 1), config_.tall_m, max_rise_m_.data(),
             bands, rise_m.data());
  const std::span<EdgeHeights> heights = of_sector(heights_, grid, sector);
  for (std::size_t band = 0; band < bands; ++band) {
    heights[band] = {lower_m[band] + std::max(-rise_m[band], 0.0F),
                     lower_m[band] + std::max(rise_m[band], 0.0F)};
  }
}

void GroundSurface::interpolate(const RingGrid& grid, int sector,
                                std::span<const std::uint8_t> is_missing,
                                std::span<float> height_m) const noexcept {
  std::array<Donor, 2 * kMostSectorsBehind> donors;
  std::size_t count = 0;
  const auto add = [&](int neighbour, int distance) {
    const std::size_t first = grid.cell(grid.wrapped(neighbour), 0);
    donors[count++] = {&traced_m_[first], reinterpret_cast<const std::uint8_t*>(&origin_[first]),
                       1.0F / static_cast<float>(distance)};
  };
  for (int distance = 1; distance <= behind_; ++distance) {
    add(sector - distance, distance);
    if (distance <= ahead_) add(sector + distance, distance);
  }
  for (std::size_t band = 0; band < static_cast<std::size_t>(grid.bands()); band += kEight) {
    std::uint64_t eight;
    std::memcpy(&eight, &is_missing[band], sizeof(eight));
    if (eight == 0) continue;
    std::array<float, kEight> mixed_m;
    std::copy_n(&height_m[band], kEight, mixed_m.begin());
    mix_eight(std::span(donors).first(count), band, mixed_m.data());
    for (std::size_t i = 0; i < kEight; ++i) {
      if (is_missing[band + i] != 0) height_m[band + i] = mixed_m[i];
    }
  }
}

}  // namespace terracut::elevation
