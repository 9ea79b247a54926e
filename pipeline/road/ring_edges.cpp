// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/ring_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::road {
namespace {

/// Patches of a ring lie on one surface if their ranges differ by less than this.
constexpr float kSameSurface_m = 1.0F;
/// How far to either side of an edge the ring is checked for an equally steep slope.
constexpr float kBeside_m = 1.5F;
constexpr float kNoGround_m = std::numeric_limits<float>::max();
/// If at least this share of the rings shows a step in the same direction, the step runs through
/// the sensor.
constexpr float kMostRings = 0.8F;
/// At least this many rings must have ground on both sides of such a step, because a few rings may
/// all be near. An HDL-64E on a car has 30 on open ground.
constexpr float kEnoughRings = 24;

/// The planes of a row, each from its first patch on, with a margin at both ends.
struct Row {
  const float *x_m, *y_m, *z_m, *range_m;
};

/// Sums over the patches on one side of each patch of a row.
struct Sums {
  float *x_m, *y_m, *z_m, *count;
};

/// Turns a condition into a factor: arithmetic instead of branches lets the compiler vectorise
/// loops.
inline float one_if(bool condition) noexcept {
  return condition ? 1.0F : 0.0F;
}

/// Does the same as std::max(), but with values: loops with references to memory are not
/// vectorised.
inline float greater(float one, float other) noexcept {
  return one > other ? one : other;
}

/// Adds to each patch's sums the patch `beside` places away, if both are on the same surface.
TERRACUT_VECTOR_CLONES void add_patch(const Row row, int beside, int count, float* __restrict x_m,
                                      float* __restrict y_m, float* __restrict z_m,
                                      float* __restrict patches) noexcept {
  for (int i = 0; i < count; ++i) {
    const int k = i + beside;
    const float share = one_if(std::fabs(row.range_m[k] - row.range_m[i]) < kSameSurface_m);
    x_m[i] += share * row.x_m[k];
    y_m[i] += share * row.y_m[k];
    z_m[i] += share * row.z_m[k];
    patches[i] += share;
  }
}

/// Turns sums into means. If no patch was added to a patch's sums, the patch itself is the mean.
TERRACUT_VECTOR_CLONES void find_means(const Row row, int count, const Sums sums,
                                       float* __restrict x_m, float* __restrict y_m,
                                       float* __restrict z_m) noexcept {
  for (int i = 0; i < count; ++i) {
    const float itself = one_if(sums.count[i] == 0);
    const float share = 1.0F / (sums.count[i] + itself);
    x_m[i] = (sums.x_m[i] + itself * row.x_m[i]) * share;
    y_m[i] = (sums.y_m[i] + itself * row.y_m[i]) * share;
    z_m[i] = (sums.z_m[i] + itself * row.z_m[i]) * share;
  }
}

/// Computes the slope between the means, relative to the terrain, for patches whose windows have
/// `reach` patches on each side.
TERRACUT_VECTOR_CLONES void find_slopes(const Sums left, const Sums right,
                                        const TerrainSlope::Gradient* terrain,
                                        const std::int32_t* reaches, int reach, int count,
                                        float least_run_m, float* __restrict slope) noexcept {
  for (int i = 0; i < count; ++i) {
    const float dx_m = right.x_m[i] - left.x_m[i];
    const float dy_m = right.y_m[i] - left.y_m[i];
    const float rise_m =
        right.z_m[i] - left.z_m[i] - (terrain[i].along_x * dx_m + terrain[i].along_y * dy_m);
    const float run_squared_m2 = dx_m * dx_m + dy_m * dy_m;
    const float run_m = std::sqrt(std::max(run_squared_m2, least_run_m * least_run_m));
    slope[i] += one_if(reaches[i] == reach) * (rise_m / run_m);
  }
}

/// Counts for each patch the rings with ground on both sides within `most_range_m`, and how many of
/// these rise or fall across the patch by more than `step_m`, measured both absolutely and relative
/// to their slope beside it.
TERRACUT_VECTOR_CLONES void add_steps(const Row row, float most_range_m, float step_m, int count,
                                      float* __restrict rings, float* __restrict rises,
                                      float* __restrict falls) noexcept {
  for (int i = 0; i < count; ++i) {
    const float nearer_m = greater(row.range_m[i - 1], row.range_m[i + 1]);
    const float farther_m = greater(row.range_m[i - 3], row.range_m[i + 3]);
    const float across_m = row.z_m[i + 1] - row.z_m[i - 1];
    const float beside_m = row.z_m[i + 3] - row.z_m[i + 1] + (row.z_m[i - 1] - row.z_m[i - 3]);
    const float against_m = across_m - 0.5F * beside_m;
    const float is_known = one_if(greater(nearer_m, farther_m) < most_range_m);
    rings[i] += is_known;
    rises[i] += one_if(is_known * -greater(-across_m, -against_m) > step_m);
    falls[i] += one_if(is_known * greater(across_m, against_m) < -step_m);
  }
}

/// Takes the ranges of patches with ground, and kNoGround_m for the others. False if none has
/// ground.
TERRACUT_VECTOR_CLONES bool take_ranges(const float* range_m, const std::uint8_t* has_ground,
                                        std::size_t count, float* __restrict taken_m) noexcept {
  std::uint8_t is_any = 0;
  for (std::size_t i = 0; i < count; ++i) is_any |= has_ground[i];
  for (std::size_t i = 0; i < count; ++i) {
    const float range = range_m[i];
    taken_m[i] = has_ground[i] != 0 ? range : kNoGround_m;
  }
  return is_any != 0;
}

}  // namespace

RingEdges::RingEdges(const Config& config, const GroundPatches& ground, memory::FixedMemory& memory)
    : config_(config), most_range_m_(config.width_m / ground.spacing_m(1)) {
  const auto per_row = static_cast<std::size_t>(ground.per_row());
  for (std::span<float>* values : {&x_m_, &y_m_, &z_m_, &range_m_}) {
    *values = memory.take<float>("ring edges", per_row + 2 * static_cast<std::size_t>(kMargin));
  }
  for (std::span<float>& values : sums_) values = memory.take<float>("ring edges", per_row);
  for (std::span<float>* counts : {&rings_, &rises_, &falls_}) {
    *counts = memory.take<float>("ring edges", per_row);
  }
  terrain_ = memory.take<TerrainSlope::Gradient>("ring edges", per_row);
  slope_ = memory.take<float>("ring edges", per_row);
  reach_ = memory.take<std::int32_t>("ring edges", per_row);
  is_edge_ = memory.take<std::uint8_t>("ring edges", per_row);
}

void RingEdges::begin_frame() noexcept {
  for (const std::span<float> counts : {rings_, rises_, falls_}) {
    std::fill(counts.begin(), counts.end(), 0.0F);
  }
}

bool RingEdges::runs_through_sensor(int index) const noexcept {
  const auto i = static_cast<std::size_t>(index);
  return rings_[i] >= kEnoughRings && std::max(rises_[i], falls_[i]) >= kMostRings * rings_[i];
}

std::span<const std::uint8_t> RingEdges::find(const GroundPatches& ground,
                                              const TerrainSlope& terrain, int row) noexcept {
  const auto per_row = static_cast<std::size_t>(ground.per_row());
  const std::size_t first = static_cast<std::size_t>(row) * per_row;
  if (!take_row(ground, terrain, first)) {
    std::fill(is_edge_.begin(), is_edge_.end(), std::uint8_t{0});
    return is_edge_;
  }
  count_steps(ground.per_row());
  find_slopes_across(ground.per_row());
  for (std::size_t i = 0; i < per_row; ++i) {
    is_edge_[i] = std::fabs(slope_[i]) > config_.slope && ground.has_ground()[first + i] != 0 &&
                  !goes_on_beside(ground, static_cast<int>(i));
  }
  reset_at_seam(ground, first);
  return is_edge_;
}

void RingEdges::reset_at_seam(const GroundPatches& ground, std::size_t first) noexcept {
  const auto is_seam = ground.is_seam().subspan(first, is_edge_.size());
  for (auto seam = std::ranges::find(is_seam, 1); seam != is_seam.end();
       seam = std::find(seam + 1, is_seam.end(), 1)) {
    const auto last = static_cast<int>(seam - is_seam.begin());
    const int reach = reach_[static_cast<std::size_t>(last)];
    for (int i = last - reach; i <= last + 1 + reach; ++i) {
      is_edge_[static_cast<std::size_t>(ground.wrapped(i))] = 0;
    }
  }
}

bool RingEdges::take_row(const GroundPatches& ground, const TerrainSlope& terrain,
                         std::size_t first) noexcept {
  const auto per_row = static_cast<std::size_t>(ground.per_row());
  const auto copy = [&](std::span<const float> from, std::span<float> to) {
    std::copy_n(&from[first], per_row, &to[padded(0)]);
  };
  copy(ground.x_m(), x_m_);
  copy(ground.y_m(), y_m_);
  copy(ground.z_m(), z_m_);
  if (!take_ranges(&ground.range_m()[first], &ground.has_ground()[first], per_row,
                   &range_m_[padded(0)])) {
    return false;
  }
  for (const std::span<float> values : {x_m_, y_m_, z_m_, range_m_}) {
    for (int i = 1; i <= kMargin; ++i) {
      values[padded(-i)] = values[padded(ground.wrapped(-i))];
      values[padded(ground.per_row() - 1 + i)] = values[padded(ground.wrapped(i - 1))];
    }
  }
  for (std::size_t i = 0; i < per_row; ++i) terrain_[i] = terrain.at_patch(first + i);
  ground.count_patches_over(0.5F * config_.width_m, first / per_row, reach_);
  return true;
}

void RingEdges::count_steps(int per_row) noexcept {
  const Row row{&x_m_[padded(0)], &y_m_[padded(0)], &z_m_[padded(0)], &range_m_[padded(0)]};
  add_steps(row, most_range_m_, config_.slope * config_.width_m, per_row, rings_.data(),
            rises_.data(), falls_.data());
}

void RingEdges::find_slopes_across(int per_row) noexcept {
  const Row row{&x_m_[padded(0)], &y_m_[padded(0)], &z_m_[padded(0)], &range_m_[padded(0)]};
  const auto sums_at = [this](std::size_t first) {
    return Sums{sums_[first].data(), sums_[first + 1].data(), sums_[first + 2].data(),
                sums_[first + 3].data()};
  };
  const Sums left = sums_at(0), right = sums_at(4), left_mean = sums_at(8),
             right_mean = sums_at(12);
  int least = GroundPatches::kMostPatchesOver, most = 1;
  for (int i = 0; i < per_row; ++i) {
    const bool has_ground = row.range_m[i] < kNoGround_m;
    const int reach = reach_[static_cast<std::size_t>(i)];
    least = has_ground ? std::min(least, reach) : least;
    most = has_ground ? std::max(most, reach) : most;
  }
  for (const std::span<float> sums : std::span(sums_).first(8)) {
    std::fill(sums.begin(), sums.end(), 0.0F);
  }
  std::fill(slope_.begin(), slope_.end(), 0.0F);
  for (int reach = 1; reach <= most; ++reach) {
    add_patch(row, -reach, per_row, left.x_m, left.y_m, left.z_m, left.count);
    add_patch(row, reach, per_row, right.x_m, right.y_m, right.z_m, right.count);
    if (reach < least) continue;
    find_means(row, per_row, left, left_mean.x_m, left_mean.y_m, left_mean.z_m);
    find_means(row, per_row, right, right_mean.x_m, right_mean.y_m, right_mean.z_m);
    find_slopes(left_mean, right_mean, terrain_.data(), reach_.data(), reach, per_row,
                0.5F * config_.width_m, slope_.data());
  }
}

bool RingEdges::goes_on_beside(const GroundPatches& ground, int index) const noexcept {
  const float across = slope_[static_cast<std::size_t>(index)];
  const int reach = reach_[static_cast<std::size_t>(index)];
  const int beside = ground.patches_over(kBeside_m, range_m_[padded(index)]);
  const int left = index - reach, right = index + reach;
  const auto is_as_steep = [&](float slope) {
    return std::fabs(slope - across) < config_.bend;  // false if the slope is unknown (NaN)
  };
  return is_as_steep(slope_between(index, {left - beside, left - (beside + 1) / 2},
                                   {left - beside / 2, left})) ||
         is_as_steep(slope_between(index, {right, right + beside / 2},
                                   {right + (beside + 1) / 2, right + beside}));
}

float RingEdges::slope_between(int index, Run left, Run right) const noexcept {
  const float range_m = range_m_[padded(index)];
  struct Mean {
    float x_m = 0, y_m = 0, z_m = 0;
    int count = 0;
  };
  const auto mean_of = [&](Run run) {
    Mean mean;
    for (std::size_t i = padded(run.first); i <= padded(run.last); ++i) {
      if (!(std::fabs(range_m_[i] - range_m) < kSameSurface_m)) continue;
      mean.x_m += x_m_[i];
      mean.y_m += y_m_[i];
      mean.z_m += z_m_[i];
      ++mean.count;
    }
    const float share = 1.0F / static_cast<float>(std::max(mean.count, 1));
    return Mean{mean.x_m * share, mean.y_m * share, mean.z_m * share, mean.count};
  };
  const Mean from = mean_of(left), to = mean_of(right);
  if (from.count == 0 || to.count == 0) return std::numeric_limits<float>::quiet_NaN();
  const float dx_m = to.x_m - from.x_m, dy_m = to.y_m - from.y_m;
  const float rise_m =
      to.z_m - from.z_m - terrain_[static_cast<std::size_t>(index)].rise_m(dx_m, dy_m);
  return rise_m / std::max(std::sqrt(dx_m * dx_m + dy_m * dy_m), 0.5F * config_.width_m);
}

}  // namespace terracut::road
