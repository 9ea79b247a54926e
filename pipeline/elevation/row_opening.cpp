// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/row_opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace terracut::elevation {
namespace {

/// True if no other ring lies less than RingGrid::kFarApart_m farther out on level ground.
bool is_far_from_next(const mount::Ring& ring, const mount::RingProfile& profile) {
  if (!std::isfinite(ring.ground_distance_m)) return false;
  return std::ranges::none_of(profile.rings, [&](const mount::Ring& other) {
    const double farther_m = other.ground_distance_m - ring.ground_distance_m;
    return farther_m > 0 && farther_m <= static_cast<double>(RingGrid::kFarApart_m);
  });
}

}  // namespace

RowOpening::RowOpening(const Config& config, float slope, const RingGrid& grid,
                       const mount::RingProfile& profile, memory::FixedMemory& memory)
    : sectors_(grid.sectors()),
      sector_rad_(2 * std::numbers::pi_v<float> / static_cast<float>(grid.sectors())),
      window_m_(config.window_m),
      slope_(slope),
      slots_(memory.take<std::int16_t>("row opening", profile.rings.size())) {
  for (std::size_t row = 0; row < profile.rings.size(); ++row) {
    const bool is_used = is_far_from_next(profile.rings[row], profile);
    slots_[row] = static_cast<std::int16_t>(is_used ? used_++ : -1);
  }
  if (used_ > 0) {
    behind_ = std::min(kMostBehind, (sectors_ - 1) / 2);
    ahead_ = std::min(kMostAhead, (sectors_ - 1) / 2);
  }
  const auto places = static_cast<std::size_t>(used_ * sectors_);
  lowest_m_ = memory.take<float>("row opening", places);
  range_m_ = memory.take<float>("row opening", places);
  opening_m_ = memory.take<float>("row opening", places);
}

void RowOpening::take(int row, RingGrid::Sectors sectors, const float* z_m, const float* range_m,
                      const RingGrid& grid) noexcept {
  const int begin = grid.columns_of(sectors).begin;
  for (int sector = sectors.begin; sector < sectors.end; ++sector) {
    const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
    float lowest_m = kEmpty, at_m = 0;
    for (int i = columns.begin - begin; i < columns.end - begin; ++i) {
      if (z_m[i] < lowest_m) {
        lowest_m = z_m[i];
        at_m = range_m[i];
      }
    }
    const std::size_t at = place(slots_[static_cast<std::size_t>(row)], sector);
    lowest_m_[at] = lowest_m;
    range_m_[at] = at_m;
  }
}

void RowOpening::open(int sector) noexcept {
  for (int slot = 0; slot < used_; ++slot) opening_m_[place(slot, sector)] = opened(slot, sector);
}

float RowOpening::opened(int slot, int sector) const noexcept {
  const float here_m = lowest_m_[place(slot, sector)];
  if (here_m == kEmpty) return kEmpty;
  const float sector_m = sector_rad_ * range_m_[place(slot, sector)];
  const auto width = static_cast<int>(std::ceil(std::min(window_m_ / sector_m, 1e3F)));
  const int reach = std::min(width, behind_);
  // The lowest height from here to each distance on either side.
  using Lowest = std::array<float, kMostBehind + 1>;
  const auto find_lowest = [&](int side, int most, Lowest& lowest_m) {
    lowest_m[0] = here_m;
    for (int distance = 1; distance <= reach; ++distance) {
      const auto i = static_cast<std::size_t>(distance);
      lowest_m[i] = lowest_m[i - 1];
      if (distance > most) continue;
      int other = sector + side * distance;
      if (other < 0) other += sectors_;
      if (other >= sectors_) other -= sectors_;
      const float seen_m =
          lowest_m_[place(slot, other)] + slope_ * static_cast<float>(distance) * sector_m;
      lowest_m[i] = std::min(lowest_m[i], seen_m);
    }
    return lowest_m[static_cast<std::size_t>(reach)];
  };
  Lowest behind_m, ahead_m;
  // Nothing stands out where a window to one side has nothing lower.
  if (find_lowest(-1, behind_, behind_m) == here_m) return here_m;
  if (find_lowest(1, ahead_, ahead_m) == here_m) return here_m;
  float opening_m = -kEmpty;
  for (int distance = 0; distance <= reach; ++distance) {
    opening_m = std::max(opening_m, std::min(behind_m[static_cast<std::size_t>(distance)],
                                             ahead_m[static_cast<std::size_t>(reach - distance)]));
  }
  return opening_m;
}

}  // namespace terracut::elevation
