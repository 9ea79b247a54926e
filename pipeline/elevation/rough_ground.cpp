// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/rough_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

constexpr int kNotCounted = -1;  // bytes of this value make any number negative
constexpr int kRowReach = 2;     // rows up and down whose bends count as well

/// Levels low returns of a row, and marks those to level only on rough ground.
TERRACUT_VECTOR_CLONES void level_row(const float* __restrict highest_near_m,
                                      const RoughGround::Config& config, float obstacle_height_m,
                                      std::span<float> heights_m,
                                      std::uint8_t* __restrict may_be_rough) noexcept {
  const float tall_m = config.tall_m;
  const float rough_height_m = config.rough_height_m, rough_tall_m = config.rough_tall_m;
  const std::size_t count = heights_m.size();
  float* const __restrict height_m = heights_m.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float highest_m = highest_near_m[i];
    const float h = height_m[i];
    // Integers as wide as a float need no repacking in vectors.
    const std::int32_t is_low = (h > 0 ? 1 : 0) & (h < obstacle_height_m ? 1 : 0);
    const std::int32_t is_level = is_low & (highest_m <= tall_m ? 1 : 0);
    const std::int32_t may_be = (h > 0 ? 1 : 0) & (h < rough_height_m ? 1 : 0) &
                                (highest_m <= rough_tall_m ? 1 : 0) & (is_level ^ 1);
    height_m[i] = is_level != 0 ? 0 : h;
    may_be_rough[i] = static_cast<std::uint8_t>(may_be);
  }
}

void level_those(const std::uint8_t* which, std::size_t begin, std::size_t end,
                 float* height_m) noexcept {
  for (std::size_t i = begin; i < end; ++i) height_m[i] = which[i] != 0 ? 0 : height_m[i];
}

/// Finds the maximum of `reach` values before and reach + 1 values after each place; fewer at the
/// ends.
TERRACUT_VECTOR_CLONES void find_greatest_near(const float* __restrict values, std::size_t count,
                                               std::size_t reach, float* __restrict out) noexcept {
  const auto greater = [](float a, float b) { return a > b ? a : b; };
  for (std::size_t i = 0; i < count; ++i) out[i] = values[i];
  for (std::size_t away = 1; away <= reach + 1; ++away) {
    for (std::size_t i = 0; i + away < count; ++i) out[i] = greater(out[i], values[i + away]);
  }
  for (std::size_t away = 1; away <= reach; ++away) {
    for (std::size_t i = away; i < count; ++i) out[i] = greater(out[i], values[i - away]);
  }
}

/// Takes the larger of two values in each place.
TERRACUT_VECTOR_CLONES void take_greater(const float* __restrict values, std::size_t count,
                                         float* __restrict out) noexcept {
  for (std::size_t i = 0; i < count; ++i) out[i] = values[i] > out[i] ? values[i] : out[i];
}

/// Counts the height bends between columns of a sector in a row, and those larger than `rough_m`.
TERRACUT_VECTOR_CLONES RoughGround::Bends count_bends(const float* __restrict z_m, int count,
                                                      float rough_m) noexcept {
  std::int32_t known = 0, rough = 0;
  for (int i = 0; i + 2 < count; ++i) {
    const float bend_m = std::fabs(z_m[i] - 2 * z_m[i + 1] + z_m[i + 2]);  // NaN beside a gap
    known += bend_m >= 0 ? 1 : 0;
    rough += bend_m > rough_m ? 1 : 0;
  }
  return {static_cast<std::int16_t>(known), static_cast<std::int16_t>(rough)};
}

}  // namespace

RoughGround::RoughGround(const Config& config, float obstacle_height_m, const RingGrid& grid,
                         frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      obstacle_height_m_(obstacle_height_m),
      shape_(shape),
      near_sectors_(std::min(config.near_sectors, (grid.sectors() - 1) / 2)),
      highest_near_m_(memory.take<float>("rough ground", grid.cells())) {
  if (!config.enabled) return;
  may_be_rough_ =
      memory.take<std::uint8_t>("rough ground", static_cast<std::size_t>(shape.columns));
  bends_ = memory.take<Bends>("rough ground", static_cast<std::size_t>(grid.sectors()) *
                                                  static_cast<std::size_t>(shape.rows));
  bends_beside_ = memory.take<Bends>("rough ground", bends_.size());
  is_rough_ = memory.take<Answer>("rough ground", bends_.size());
}

void RoughGround::reset() noexcept {
  if (!config_.enabled) return;
  for (const std::span<Bends> bends : {bends_, bends_beside_}) {
    std::memset(bends.data(), kNotCounted, bends.size_bytes());
  }
  std::fill(is_rough_.begin(), is_rough_.end(), kNotAsked);
}

void RoughGround::find_highest_near(RingGrid::Sectors sectors, const RingGrid& grid,
                                    std::span<const float> highest_m,
                                    std::span<const GroundSurface::EdgeHeights> ground) noexcept {
  if (!config_.enabled) return;
  const auto bands = static_cast<std::size_t>(grid.bands());
  const auto near_bands = static_cast<std::size_t>(config_.near_bands);
  std::array<float, static_cast<std::size_t>(RingGrid::kMaxBands)> beside_m;  // one value a band
  for (int sector = sectors.begin; sector < sectors.end; ++sector) {
    const std::size_t first = grid.cell(sector, 0);
    std::copy_n(&highest_m[first], bands, beside_m.begin());
    for (int away = 1; away <= near_sectors_; ++away) {
      for (const int beside : {sector - away, sector + away}) {
        take_greater(&highest_m[grid.cell(grid.wrapped(beside), 0)], bands, beside_m.data());
      }
    }
    // A return lies between the middles of a band and the next: one more band is looked at.
    find_greatest_near(beside_m.data(), bands, near_bands, &highest_near_m_[first]);
    for (std::size_t i = first; i < first + bands; ++i) highest_near_m_[i] -= ground[i].lower_m();
  }
}

void RoughGround::level(const frame::PointPlanes& points, int row, frame::ColumnRange columns,
                        std::span<const float> highest_m, const RingGrid& grid,
                        std::span<float> height_m) noexcept {
  if (!config_.enabled || columns.size() == 0) return;
  const std::uint8_t* const may_be = may_be_rough_.data();
  level_row(highest_m.data(), config_, obstacle_height_m_, height_m, may_be_rough_.data());
  for (std::size_t i = 0;;) {
    const void* const found = std::memchr(may_be + i, 1, columns.size() - i);
    if (found == nullptr) return;
    i = static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - may_be);
    const int sector = grid.sector_of(columns.begin + static_cast<int>(i));
    const int last = std::min(grid.columns_of({sector, sector + 1}).end, columns.end);
    const auto end = static_cast<std::size_t>(last - columns.begin);
    if (is_rough(points, grid, row, sector)) level_those(may_be, i, end, height_m.data());
    i = end;
  }
}

bool RoughGround::is_rough(const frame::PointPlanes& points, const RingGrid& grid, int row,
                           int sector) noexcept {
  Answer& is_rough = is_rough_[place(grid, row, sector)];
  if (is_rough != kNotAsked) return is_rough == kYes;
  int known = 0, rough = 0;
  const int last = std::min(row + kRowReach, shape_.rows - 1);
  for (int near = std::max(row - kRowReach, 0); near <= last; ++near) {
    const Bends bends = bends_beside(points, grid, near, sector);
    known += bends.known;
    rough += bends.rough;
  }
  is_rough = 2 * rough > known ? kYes : kNo;
  return is_rough == kYes;
}

RoughGround::Bends RoughGround::bends_beside(const frame::PointPlanes& points, const RingGrid& grid,
                                             int row, int sector) noexcept {
  Bends& beside = bends_beside_[place(grid, row, sector)];
  if (beside.known >= 0) return beside;
  int known = 0, rough = 0;
  for (int aside = -near_sectors_; aside <= near_sectors_; ++aside) {
    const Bends bends = bends_of(points, grid, row, grid.wrapped(sector + aside));
    known += bends.known;
    rough += bends.rough;
  }
  return beside = {static_cast<std::int16_t>(known), static_cast<std::int16_t>(rough)};
}

RoughGround::Bends RoughGround::bends_of(const frame::PointPlanes& points, const RingGrid& grid,
                                         int row, int sector) noexcept {
  Bends& bends = bends_[place(grid, row, sector)];
  if (bends.known < 0) {
    const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
    bends = count_bends(&points.z_m[shape_.cell(row, columns.begin)],
                        static_cast<int>(columns.size()), config_.rough_m);
  }
  return bends;
}

}  // namespace terracut::elevation
