// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/ring_elevation_map.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "pipeline/stage/float_lanes.hpp"
#include "pipeline/stage/row_steps.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

using stage::EightFloats, stage::EightInts, stage::kEight, stage::FourFloats, stage::FourInts;

// Each loop over a row's columns gets all it reads and writes as parameters, for __restrict:
// without it the loops are not vectorised in clones.

/// The ground below a row's returns.
struct GroundOfRow {
  const std::int32_t* first_cell;  // by column: its sector's first cell
  const float* share_across;       // by column
  const GroundSurface::EdgeHeights* heights;
  RingGrid::BandMixes mixes;
};

/// Finds for each return its height above the surface, interpolated between two bands in range and
/// the two edges of the sector. Takes four returns at a time; loading the table entries, which are
/// adjacent, is more than half of the work.
TERRACUT_VECTOR_CLONES_OF_INLINED void find_heights(const float* __restrict z_m,
                                                    const float* __restrict range_m,
                                                    const GroundOfRow& ground,
                                                    std::span<float> height_m) noexcept {
  const RingGrid::BandMix* const __restrict of_step = ground.mixes.of_step;
  const std::int32_t* const __restrict first_cell = ground.first_cell;
  const GroundSurface::EdgeHeights* const __restrict heights = ground.heights;
  const FourFloats last_step = ground.mixes.last_step - FourFloats{};
  const std::size_t count = height_m.size();
  float* const __restrict out = height_m.data();
  const auto mixed = [](auto from, auto to, auto share)
                         __attribute__((always_inline)) { return from + share * (to - from); };
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const FourFloats steps = stage::load_four(range_m + i) * RingGrid::kStepsPerMetre;
    const FourInts step = __builtin_convertvector(steps < last_step ? steps : last_step, FourInts);
    const auto mix = [&](int lane) { return of_step[static_cast<std::uint32_t>(step[lane])]; };
    const RingGrid::BandMix a = mix(0), b = mix(1), c = mix(2), d = mix(3);
    const std::int32_t cell_a = first_cell[i] + a.inner, cell_b = first_cell[i + 1] + b.inner,
                       cell_c = first_cell[i + 2] + c.inner, cell_d = first_cell[i + 3] + d.inner;
    // Loads the edges of each return's cell and of the next cell, then sorts them into first and
    // last edges.
    const auto edges = [&](std::int32_t cell) {
      FourFloats four;
      std::memcpy(&four, heights + cell, sizeof(four));
      return four;
    };
    const FourFloats edges_a = edges(cell_a), edges_b = edges(cell_b), edges_c = edges(cell_c),
                     edges_d = edges(cell_d);
    const FourFloats inner_ab = __builtin_shufflevector(edges_a, edges_b, 0, 4, 1, 5);
    const FourFloats outer_ab = __builtin_shufflevector(edges_a, edges_b, 2, 6, 3, 7);
    const FourFloats inner_cd = __builtin_shufflevector(edges_c, edges_d, 0, 4, 1, 5);
    const FourFloats outer_cd = __builtin_shufflevector(edges_c, edges_d, 2, 6, 3, 7);
    const FourFloats outer_share{a.outer_share, b.outer_share, c.outer_share, d.outer_share};
    const FourFloats first =
        mixed(__builtin_shufflevector(inner_ab, inner_cd, 0, 1, 4, 5),
              __builtin_shufflevector(outer_ab, outer_cd, 0, 1, 4, 5), outer_share);
    const FourFloats last =
        mixed(__builtin_shufflevector(inner_ab, inner_cd, 2, 3, 6, 7),
              __builtin_shufflevector(outer_ab, outer_cd, 2, 3, 6, 7), outer_share);
    const FourFloats surface = mixed(first, last, stage::load_four(ground.share_across + i));
    const FourFloats above = stage::load_four(z_m + i) - surface;
    std::memcpy(out + i, &above, sizeof(above));
  }
  for (; i < count; ++i) {
    const float steps = range_m[i] * RingGrid::kStepsPerMetre;
    const RingGrid::BandMix mix = of_step[static_cast<std::int32_t>(
        steps < ground.mixes.last_step ? steps : ground.mixes.last_step)];
    const std::int32_t cell = first_cell[i] + mix.inner;
    const GroundSurface::EdgeHeights &inner = heights[cell], &outer = heights[cell + 1];
    const float first_m = mixed(inner.first_m, outer.first_m, mix.outer_share);
    const float last_m = mixed(inner.last_m, outer.last_m, mix.outer_share);
    out[i] = z_m[i] - mixed(first_m, last_m, ground.share_across[i]);
  }
}

/// Finds heights above the lowest return of the grid cell.
void find_heights_above(std::span<const GroundSurface::LowestReturn> lowest, const RingGrid& grid,
                        const float* z_m, const float* range_m, int first_column,
                        std::span<float> height_m) noexcept {
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    const int sector = grid.sector_of(first_column + static_cast<int>(i));
    height_m[i] = z_m[i] - lowest[grid.cell(sector, grid.band_of(range_m[i]))].height_m;
  }
}

/// Labels by height alone.
TERRACUT_VECTOR_CLONES void label_heights(std::span<const float> height_m, float obstacle_height_m,
                                          frame::Label* __restrict label) noexcept {
  const std::size_t count = height_m.size();
  const float* const __restrict height = height_m.data();
  for (std::size_t i = 0; i < count; ++i) {
    const frame::Label known =
        height[i] < obstacle_height_m ? frame::Label::kGround : frame::Label::kObstacle;
    label[i] = height[i] == height[i] ? known : frame::Label::kNone;
  }
}

/// Makes obstacles of the returns that are higher than `most_m`, by column.
TERRACUT_VECTOR_CLONES void label_higher(const float* __restrict z_m, std::span<const float> most_m,
                                         frame::Label* __restrict label) noexcept {
  const std::size_t count = most_m.size();
  const float* const __restrict most = most_m.data();
  for (std::size_t i = 0; i < count; ++i) {
    label[i] = z_m[i] > most[i] ? frame::Label::kObstacle : label[i];
  }
}

using Extremes = RingElevationMap::Extremes;

// The lowest and the highest return of a grid cell are found together as the minimum of a pair of
// numbers: one instruction without a branch, which would be mispredicted. The upper half of a
// number has the bits of a height and so its order, whatever the lower half.

std::uint64_t upper_half(float height_m) noexcept {
  return std::uint64_t{std::bit_cast<std::uint32_t>(height_m)} << 32;
}
float height_in(double number) noexcept {
  return std::bit_cast<float>(
      static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number) >> 32));
}

/// The last bits of a return's range make place for its row: the range is good to 2^-15 of itself.
constexpr std::uint32_t kRowBits = 0xFF;
constexpr std::uint32_t kNoRow = kRowBits;  ///< The row is not known.

/// Orders equally low returns by range, the nearer first. A larger lower half makes a positive
/// number larger and a negative one smaller, so for these the bits are inverted.
std::uint32_t lower_half(float height_m, std::uint32_t range_and_row) noexcept {
  const auto all_if_negative =
      static_cast<std::uint32_t>(std::bit_cast<std::int32_t>(height_m) >> 31);
  return range_and_row ^ all_if_negative;
}

Extremes extremes_of(float height_m, float range_m, std::uint32_t row) noexcept {
  const std::uint32_t range_and_row = (std::bit_cast<std::uint32_t>(range_m) & ~kRowBits) | row;
  return Extremes{std::bit_cast<double>(upper_half(height_m) | lower_half(height_m, range_and_row)),
                  std::bit_cast<double>(upper_half(-height_m))};
}
std::uint32_t range_and_row_of_lowest(const Extremes& extremes) noexcept {
  const auto bits = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(extremes[0]));
  return lower_half(height_in(extremes[0]), bits);
}

void take(const Extremes& more, Extremes& extremes) noexcept {
  extremes = more < extremes ? more : extremes;
}

constexpr float kNowhere_m = GroundSurface::kEmpty;  // for the lowest and, negated, the highest

Extremes nothing() noexcept {
  return Extremes{extremes_of(kNowhere_m, 0, kNoRow)[0], extremes_of(-kNowhere_m, 0, kNoRow)[1]};
}

/// Writes the extremes of eight returns of a row, of which those in `ground_m` may be ground, as if
/// each were alone in its grid cell, four halves each; the third may have any value. Stores whole
/// cells: single halves would be read back before they are in the cache.
[[gnu::always_inline]] inline void find_eight_extremes(const float* ground_m, const float* z_m,
                                                       const float* range_m, std::uint32_t row,
                                                       std::uint32_t* halves) noexcept {
  EightFloats ground, z, range;
  std::memcpy(&ground, ground_m, sizeof(ground));
  std::memcpy(&z, z_m, sizeof(z));
  std::memcpy(&range, range_m, sizeof(range));
  const EightInts may_be_ground = ground == ground;
  const EightFloats nowhere = kNowhere_m - EightFloats{};
  const auto lowest = reinterpret_cast<EightInts>(may_be_ground ? ground : nowhere);
  const auto below_highest = reinterpret_cast<EightInts>(z == z ? -z : nowhere);
  const auto of_row = static_cast<std::int32_t>(row);
  const EightInts range_and_row =
      (reinterpret_cast<EightInts>(range) & ~static_cast<std::int32_t>(kRowBits)) | of_row;
  const EightInts lower = (range_and_row & may_be_ground) ^ lowest >> 31;
  const auto store = [halves](std::size_t cell,
                              const EightInts& two) __attribute__((always_inline)) {
    std::memcpy(halves + 4 * cell, &two, sizeof(two) / 2);
    std::memcpy(halves + 4 * (cell + 4), reinterpret_cast<const char*>(&two) + sizeof(two) / 2,
                sizeof(two) / 2);
  };
  // Interleaves for cells 0, 1, 4, 5, then for 2, 3, 6, 7.
  const EightInts low = __builtin_shufflevector(lower, lowest, 0, 8, 1, 9, 4, 12, 5, 13);
  const EightInts low_behind = __builtin_shufflevector(lower, lowest, 2, 10, 3, 11, 6, 14, 7, 15);
  const EightInts high =
      __builtin_shufflevector(below_highest, below_highest, 0, 0, 1, 1, 4, 4, 5, 5);
  const EightInts high_behind =
      __builtin_shufflevector(below_highest, below_highest, 2, 2, 3, 3, 6, 6, 7, 7);
  store(0, __builtin_shufflevector(low, high, 0, 1, 8, 9, 4, 5, 12, 13));
  store(1, __builtin_shufflevector(low, high, 2, 3, 10, 11, 6, 7, 14, 15));
  store(2, __builtin_shufflevector(low_behind, high_behind, 0, 1, 8, 9, 4, 5, 12, 13));
  store(3, __builtin_shufflevector(low_behind, high_behind, 2, 3, 10, 11, 6, 7, 14, 15));
}

/// Does the same for any number of cells.
TERRACUT_VECTOR_CLONES_OF_INLINED void find_extremes(const float* __restrict ground_m,
                                                     const float* __restrict z_m,
                                                     const float* __restrict range_m,
                                                     std::uint32_t row, std::size_t count,
                                                     std::uint32_t* __restrict halves) noexcept {
  if (count < kEight) {
    for (std::size_t i = 0; i < count; ++i) {
      Extremes one = z_m[i] == z_m[i] ? extremes_of(z_m[i], range_m[i], row) : nothing();
      if (ground_m[i] != ground_m[i]) one[0] = nothing()[0];
      std::memcpy(halves + 4 * i, &one, sizeof(one));
    }
    return;
  }
  for (std::size_t next = 0; next < count; next += kEight) {
    const std::size_t first = std::min(next, count - kEight);  // the last block overlaps
    find_eight_extremes(ground_m + first, z_m + first, range_m + first, row, halves + 4 * first);
  }
}

/// Adds each return of a row to the extremes of its grid cell. Goes along four parts of the row at
/// once: returns next to each other share a cell, and each would wait for the one before.
void take_each(const std::uint32_t* __restrict halves, const std::int32_t* __restrict first_cell,
               std::span<const std::uint16_t> steps, const RingGrid& grid,
               Extremes* __restrict extremes) noexcept {
  const auto take_at = [&](std::size_t i) noexcept {
    const auto cell = static_cast<std::uint32_t>(first_cell[i] + grid.band_of_step(steps[i]));
    Extremes one;
    std::memcpy(&one, halves + 4 * i, sizeof(one));
    take(one, extremes[cell]);
  };
  const std::size_t part = steps.size() / 4;
  for (std::size_t i = 0; i < part; ++i) {
    take_at(i);
    take_at(i + part);
    take_at(i + 2 * part);
    take_at(i + 3 * part);
  }
  for (std::size_t i = 4 * part; i < steps.size(); ++i) take_at(i);
}

}  // namespace

RingElevationMap::RingElevationMap(const Config& config, const mount::RingProfile& profile,
                                   frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      grid_(config.grid, profile, shape, memory),
      surface_(config.surface, config.obstacle_height_m, grid_, memory),
      lone_(config.lone_depth_m, grid_, shape, memory),
      opening_(config.opening, config.surface.far_slope, grid_,
               has_surface() ? profile : mount::RingProfile{}, memory),
      rows_with_lone_(has_surface() ? stage::rows_that_meet_ground(profile) : 0),
      lowest_(memory.take<GroundSurface::LowestReturn>("ring grid", grid_.cells())),
      extremes_(memory.take<Extremes>("ring grid", grid_.cells())),
      row_halves_(
          memory.take<std::uint32_t>("ring grid", 4 * static_cast<std::size_t>(shape.columns))),
      row_steps_(memory.take<std::uint16_t>("ring grid", row_halves_.size() / 4)),
      row_kept_m_(memory.take<float>("ring grid", row_steps_.size())) {}

void RingElevationMap::begin() noexcept {
  taken_ = traced_ = given_ = settled_ = 0;
  std::fill(extremes_.begin(), extremes_.end(), nothing());
}

void RingElevationMap::begin_next_turn() noexcept {
  for (int* step : {&taken_, &traced_, &given_, &settled_}) *step -= grid_.sectors();
}

void RingElevationMap::take_to(int end, const frame::PointPlanes& points) noexcept {
  if (taken_ < end) take_columns(points, {taken_, end});
  taken_ = end;
}

bool RingElevationMap::can_go_on() const noexcept {
  const int opening = opening_.behind() + opening_.ahead();
  const int strip = GroundSurface::kStripBehind + GroundSurface::kStripAhead;
  return has_surface() && opening + strip + surface_.behind() + surface_.ahead() < grid_.sectors();
}

void RingElevationMap::settle() noexcept {
  const int traced = taken_ - opening_.ahead();
  const int given = traced - GroundSurface::kStripAhead;
  settle_to(traced, given, given - surface_.ahead());
}

void RingElevationMap::settle_until(int sector) noexcept {
  settle_to(sector, sector, sector);
}

void RingElevationMap::settle_to(int traced, int given, int settled) noexcept {
  for (; traced_ < traced; ++traced_) trace(grid_.wrapped(traced_));
  if (!has_surface()) {
    given_ = settled_ = traced_;
    return;
  }
  for (; given_ < given; ++given_) surface_.find_donors(grid_, grid_.wrapped(given_));
  for (; settled_ < settled; ++settled_) {
    surface_.estimate(grid_, grid_.wrapped(settled_), lowest_);
  }
}

void RingElevationMap::trace(int sector) noexcept {
  find_lowest(sector);
  if (has_surface()) surface_.trace(grid_, sector, lowest_);
}

void RingElevationMap::take_columns(const frame::PointPlanes& points,
                                    RingGrid::Sectors sectors) noexcept {
  const frame::ColumnRange columns = grid_.columns_of(sectors);
  const std::span<std::uint16_t> steps = row_steps_.first(columns.size());
  const std::int32_t* const first_cell =
      &grid_.first_cell_of_column()[static_cast<std::size_t>(columns.begin)];
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t first = shape_.cell(row, columns.begin);
    const float* const z_m = &points.z_m[first];
    const float* ground_m = z_m;
    const float* const range_m = &points.ground_range_m[first];
    if (row < rows_with_lone_) {
      lone_.take_out(&points.z_m[shape_.cell(row, 0)], columns, row_kept_m_);
      ground_m = row_kept_m_.data();
    }
    if (opening_.has(row)) opening_.take(row, sectors, ground_m, range_m, grid_);
    find_extremes(ground_m, z_m, range_m, static_cast<std::uint32_t>(row), columns.size(),
                  row_halves_.data());
    grid_.find_steps({range_m, steps.size()}, steps);
    take_each(row_halves_.data(), first_cell, steps, grid_, extremes_.data());
  }
}

void RingElevationMap::find_lowest(int sector) noexcept {
  opening_.open(sector);
  for (std::size_t i = grid_.cell(sector, 0); i < grid_.cell(sector + 1, 0); ++i) {
    const float height_m = height_in(extremes_[i][0]);
    const std::uint32_t range_and_row = range_and_row_of_lowest(extremes_[i]);
    const auto row = static_cast<int>(range_and_row & kRowBits);
    const float highest_m = -height_in(extremes_[i][1]);
    const bool has_only_lone = height_m == kNowhere_m && highest_m != -kNowhere_m;
    const bool stands_out =
        opening_.has(row) && height_m - opening_.opening_m(row, sector) > config_.obstacle_height_m;
    lowest_[i] = {has_only_lone ? highest_m : height_m,
                  std::bit_cast<float>(range_and_row & ~kRowBits), highest_m,
                  has_only_lone || stands_out ? 1 : 0};
    extremes_[i] = nothing();
  }
}

void RingElevationMap::take_extra(int column, float z_m, float ground_range_m) noexcept {
  const int sector = grid_.sector_of(column);
  if (sector < traced_) return;
  take(extremes_of(z_m, ground_range_m, kNoRow),
       extremes_[grid_.cell(sector, grid_.band_of(ground_range_m))]);
}

float RingElevationMap::height_of(int column, float z_m, float ground_range_m) const noexcept {
  const auto i = static_cast<std::size_t>(column);
  float height_m = 0;
  if (has_surface()) {
    find_heights(&z_m, &ground_range_m,
                 {&grid_.first_cell_of_column()[i], &grid_.share_across()[i],
                  surface_.heights().data(), grid_.mixes()},
                 {&height_m, 1});
  } else {
    find_heights_above(lowest_, grid_, &z_m, &ground_range_m, column, {&height_m, 1});
  }
  return height_m;
}

void RingElevationMap::label(const frame::PointPlanes& points, frame::ColumnRange columns,
                             stage::CellPlanes& planes) noexcept {
  constexpr std::size_t kShort = 512;  // column ranges too short for the processor to foresee
  const auto first = static_cast<std::size_t>(columns.begin);
  const GroundOfRow ground{&grid_.first_cell_of_column()[first], &grid_.share_across()[first],
                           surface_.heights().data(), grid_.mixes()};
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t cell = shape_.cell(row, columns.begin);
    if (row + 1 < shape_.rows && columns.size() < kShort) {
      const std::size_t above = cell + static_cast<std::size_t>(shape_.stride());
      points.fetch(above, above + columns.size());
    }
    const std::span<float> height_m = planes.height_m.subspan(cell, columns.size());
    if (has_surface()) {
      find_heights(&points.z_m[cell], &points.ground_range_m[cell], ground, height_m);
    } else {
      find_heights_above(lowest_, grid_, &points.z_m[cell], &points.ground_range_m[cell],
                         columns.begin, height_m);
    }
    label_heights(height_m, config_.obstacle_height_m, &planes.label[cell]);
    if (opening_.has(row)) {
      label_standing_out(&points.z_m[cell], row, columns, &planes.label[cell]);
    }
  }
}

void RingElevationMap::label_standing_out(const float* z_m, int row, frame::ColumnRange columns,
                                          frame::Label* label) noexcept {
  const std::span<float> most_m = row_kept_m_.first(columns.size());
  for (int column = columns.begin; column < columns.end;) {
    const int sector = grid_.sector_of(column);
    const int end = std::min(grid_.columns_of({sector, sector + 1}).end, columns.end);
    std::fill(most_m.begin() + (column - columns.begin), most_m.begin() + (end - columns.begin),
              opening_.opening_m(row, sector) + config_.obstacle_height_m);
    column = end;
  }
  label_higher(z_m, most_m, label);
}

}  // namespace terracut::elevation
