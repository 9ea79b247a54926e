// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/row_opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "pipeline/stage/float_lanes.hpp"
#include "rt/vector_clones.hpp"

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

using stage::EightFloats, stage::EightInts, stage::kEight;

/// Returns the first of the lowest heights; `count` if all are NaN. Has no branch that depends on
/// heights: it would be mispredicted.
[[gnu::always_inline]] inline int first_lowest(const float* z_m, int count) noexcept {
  constexpr int kAtOnce = kEight;
  if (count < kAtOnce) {
    int lowest = count;
    for (int i = count - 1; i >= 0; --i) {
      const float lowest_m = lowest < count ? z_m[lowest] : std::numeric_limits<float>::max();
      lowest = z_m[i] <= lowest_m ? i : lowest;
    }
    return lowest;
  }
  // Lane n has the lowest height of returns n, n + 8, .. and its place; the last eight overlap.
  EightFloats lowest_m = std::numeric_limits<float>::max() - EightFloats{};
  EightInts lowest = count - EightInts{};
  EightInts at{0, 1, 2, 3, 4, 5, 6, 7};
  for (int next = 0; next < count; next += kAtOnce) {
    const int first = std::min(next, count - kAtOnce);
    EightFloats here_m;
    std::memcpy(&here_m, z_m + first, sizeof(here_m));
    const EightInts is_lower = here_m < lowest_m;
    lowest_m = is_lower ? here_m : lowest_m;
    lowest = is_lower ? at + first : lowest;
  }
  // Halves the lanes until one is left.
  const auto keep_lower = [&](const EightFloats& other_m,
                              const EightInts& other) __attribute__((always_inline)) {
    const EightInts is_lower = (other_m < lowest_m) | ((other_m == lowest_m) & (other < lowest));
    lowest_m = is_lower ? other_m : lowest_m;
    lowest = is_lower ? other : lowest;
  };
  keep_lower(__builtin_shufflevector(lowest_m, lowest_m, 4, 5, 6, 7, 4, 5, 6, 7),
             __builtin_shufflevector(lowest, lowest, 4, 5, 6, 7, 4, 5, 6, 7));
  keep_lower(__builtin_shufflevector(lowest_m, lowest_m, 2, 3, 2, 3, 2, 3, 2, 3),
             __builtin_shufflevector(lowest, lowest, 2, 3, 2, 3, 2, 3, 2, 3));
  keep_lower(__builtin_shufflevector(lowest_m, lowest_m, 1, 1, 1, 1, 1, 1, 1, 1),
             __builtin_shufflevector(lowest, lowest, 1, 1, 1, 1, 1, 1, 1, 1));
  return lowest[0];
}

/// What one sector is compared with another by, an array by slot each.
struct Compared {
  const float *lowest_m, *sector_m, *window_sectors;
};

/// Marks the slots whose height is above that of another sector, if their window reaches so far.
/// `slope` is how many times a sector's width heights may rise in between.
TERRACUT_VECTOR_CLONES void mark_above(const Compared& here, const float* __restrict other_m,
                                       float distance, float slope,
                                       std::span<std::int32_t> marks) noexcept {
  const float* const __restrict lowest_m = here.lowest_m, * const __restrict sector_m = here.sector_m, * const __restrict window_sectors = here.window_sectors;
  std::int32_t* const __restrict mark = marks.data();
  const std::size_t slots = marks.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const float seen_m = other_m[slot] + slope * sector_m[slot];
    mark[slot] |= (window_sectors[slot] > distance - 1 ? 1 : 0) & (seen_m < lowest_m[slot] ? 1 : 0);
  }
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
  const auto slots = static_cast<std::size_t>(used_);
  sector_m_ = memory.take<float>("row opening", slots);
  window_sectors_ = memory.take<float>("row opening", slots);
  is_lower_behind_ = memory.take<std::int32_t>("row opening", slots);
  is_lower_ahead_ = memory.take<std::int32_t>("row opening", slots);
}

TERRACUT_VECTOR_CLONES_OF_INLINED void RowOpening::take(int row, RingGrid::Sectors sectors,
                                                        const float* z_m, const float* range_m,
                                                        const RingGrid& grid) noexcept {
  const int begin = grid.columns_of(sectors).begin;
  for (int sector = sectors.begin; sector < sectors.end; ++sector) {
    const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
    const int first = columns.begin - begin, end = columns.end - begin;
    const int lowest = first + first_lowest(z_m + first, end - first);
    const std::size_t at = place(slots_[static_cast<std::size_t>(row)], sector);
    lowest_m_[at] = lowest < end ? z_m[lowest] : kEmpty;
    range_m_[at] = lowest < end ? range_m[lowest] : 0;
  }
}

void RowOpening::open(int sector) noexcept {
  if (used_ == 0) return;
  const std::size_t first = place(0, sector);
  const auto slots = static_cast<std::size_t>(used_);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    sector_m_[slot] = sector_rad_ * range_m_[first + slot];
    window_sectors_[slot] = window_m_ / sector_m_[slot];
  }
  find_lower(sector, -1, behind_, is_lower_behind_);
  find_lower(sector, 1, ahead_, is_lower_ahead_);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    // Nothing stands out where a window to one side has nothing lower.
    const bool may_stand_out =
        (is_lower_behind_[slot] & is_lower_ahead_[slot]) != 0 && lowest_m_[first + slot] != kEmpty;
    opening_m_[first + slot] =
        may_stand_out ? opened(static_cast<int>(slot), sector) : lowest_m_[first + slot];
  }
}

void RowOpening::find_lower(int sector, int side, int most,
                            std::span<std::int32_t> is_lower) const noexcept {
  const Compared here{&lowest_m_[place(0, sector)], sector_m_.data(), window_sectors_.data()};
  std::ranges::fill(is_lower, 0);
  for (int distance = 1; distance <= most; ++distance) {
    const int other = (sector + side * distance + sectors_) % sectors_;
    mark_above(here, &lowest_m_[place(0, other)], static_cast<float>(distance),
               slope_ * static_cast<float>(distance), is_lower);
  }
}

float RowOpening::opened(int slot, int sector) const noexcept {
  const float here_m = lowest_m_[place(slot, sector)];
  const float sector_m = sector_m_[static_cast<std::size_t>(slot)];
  const auto width =
      static_cast<int>(std::ceil(std::min(window_sectors_[static_cast<std::size_t>(slot)], 1e3F)));
  const int reach = std::min(width, behind_);
  // The lowest height from here to each distance on either side.
  using Lowest = std::array<float, kMostBehind + 1>;
  const auto find_lowest = [&](int side, int most, Lowest& lowest_m) {
    lowest_m[0] = here_m;
    for (int distance = 1; distance <= reach; ++distance) {
      const auto i = static_cast<std::size_t>(distance);
      lowest_m[i] = lowest_m[i - 1];
      if (distance > most) continue;
      const int other = (sector + side * distance + sectors_) % sectors_;
      const float seen_m =
          lowest_m_[place(slot, other)] + slope_ * static_cast<float>(distance) * sector_m;
      lowest_m[i] = std::min(lowest_m[i], seen_m);
    }
  };
  Lowest behind_m, ahead_m;
  find_lowest(-1, behind_, behind_m);
  find_lowest(1, ahead_, ahead_m);
  float opening_m = -kEmpty;
  for (int distance = 0; distance <= reach; ++distance) {
    opening_m = std::max(opening_m, std::min(behind_m[static_cast<std::size_t>(distance)],
                                             ahead_m[static_cast<std::size_t>(reach - distance)]));
  }
  return opening_m;
}

}  // namespace terracut::elevation
