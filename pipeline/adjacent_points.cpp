// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/adjacent_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "pipeline/row_steps.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::pipeline {
namespace {

/// Eq. 5: the least horizontal distance of two beams' ground points on ground no steeper than K.
/// delta is the angle of a beam from the downward normal, h the height the beams start from.
double least_distance_m(double height_m, double lower_elevation_rad, double upper_elevation_rad,
                        double max_slope_rad) {
  const double tan_delta1 = std::tan(std::numbers::pi / 2 + lower_elevation_rad);
  const double tan_delta2 = std::tan(std::numbers::pi / 2 + upper_elevation_rad);
  return height_m * (tan_delta2 - tan_delta1) / (std::tan(max_slope_rad) * tan_delta2 + 1);
}

/// The planes one run of column pairs reads and writes, each already at its first cell.
struct Run {
  const float *lower_x, *lower_y, *lower_z, *lower_height;
  const float *upper_x, *upper_y, *upper_z, *upper_height;
  std::uint8_t *lower_steep, *upper_steep;
  int count;
};

// The loops below are the stage. They have no branches, so that the compiler turns them into
// vector code; comparisons with the NaN heights of empty cells are false. Everything they use is
// copied first: a store through a byte pointer could change it, for all the compiler knows.

/// Pairs whose step from lower to upper return is too steep: 1 in `steep`, else 0.
TERRACUT_VECTOR_CLONES void find_steep_steps(const Run run, float min_rise_m,
                                             float min_upper_height_m, float tan_max_slope_squared,
                                             std::uint8_t* steep) noexcept {
  constexpr float kAnyHeight = -std::numeric_limits<float>::infinity();  // but not NaN
  const int count = run.count;
  for (int i = 0; i < count; ++i) {
    const float dx = run.upper_x[i] - run.lower_x[i];
    const float dy = run.upper_y[i] - run.lower_y[i];
    const float rise = run.upper_z[i] - run.lower_z[i];
    steep[i] = (rise >= min_rise_m) & ((dx * dx + dy * dy) * tan_max_slope_squared < rise * rise) &
               (run.upper_height[i] >= min_upper_height_m) & (run.lower_height[i] >= kAnyHeight);
  }
}

/// Marks what find_steep_steps() found: the upper return, and the lower one where it is high
/// enough.
TERRACUT_VECTOR_CLONES void mark_steep_steps(const Run run, float min_lower_height_m,
                                             const std::uint8_t* steep) noexcept {
  const int count = run.count;
  for (int i = 0; i < count; ++i) {
    run.upper_steep[i] = static_cast<std::uint8_t>(run.upper_steep[i] | steep[i]);
  }
  for (int i = 0; i < count; ++i) {
    const std::uint8_t is_high = run.lower_height[i] >= min_lower_height_m;
    run.lower_steep[i] = static_cast<std::uint8_t>(run.lower_steep[i] | (steep[i] & is_high));
  }
}

TERRACUT_VECTOR_CLONES void mark_by_ring_spacing(const Run run, float bound_m) noexcept {
  const float bound_squared = bound_m * bound_m;
  const int count = run.count;
  for (int i = 0; i < count; ++i) {
    const float dx = run.upper_x[i] - run.lower_x[i];
    const float dy = run.upper_y[i] - run.lower_y[i];
    const bool steep = (dx * dx + dy * dy < bound_squared) &
                       (run.upper_height[i] == run.upper_height[i]) &
                       (run.lower_height[i] == run.lower_height[i]);
    run.upper_steep[i] = static_cast<std::uint8_t>(run.upper_steep[i] | std::uint8_t{steep});
  }
}

TERRACUT_VECTOR_CLONES void make_obstacles(std::span<const std::uint8_t> steep,
                                           std::span<Label> label) noexcept {
  for (std::size_t cell = 0; cell < steep.size(); ++cell) {
    label[cell] = steep[cell] != 0 ? Label::kObstacle : label[cell];
  }
}

}  // namespace

AdjacentPoints::AdjacentPoints(const Config& config, const calib::RingProfile& profile,
                               ImageShape shape, rt::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      tan_max_slope_squared_(
          static_cast<float>(std::pow(std::tan(static_cast<double>(config.max_slope_rad)), 2))),
      ring_spacing_m_(memory.take<float>(
          "adjacent points", static_cast<std::size_t>(config.last_row_step * shape.rows))),
      upper_row_(memory.take<std::int32_t>("adjacent points", ring_spacing_m_.size())),
      steep_pairs_(
          memory.take<std::uint8_t>("adjacent points", static_cast<std::size_t>(shape.columns))) {
  const RowSteps row_steps(profile, static_cast<double>(config.row_step_deg));
  for (int step = 1; step <= config.last_row_step; ++step) {
    for (int row = 0; row < shape.rows; ++row) {
      const auto pair = static_cast<std::size_t>((step - 1) * shape.rows + row);
      upper_row_[pair] = row_steps.up(row, step);
      if (upper_row_[pair] == shape.rows) continue;
      const calib::Ring& lower = profile.rings[static_cast<std::size_t>(row)];
      const calib::Ring& upper = profile.rings[static_cast<std::size_t>(upper_row_[pair])];
      if (!std::isfinite(upper.ground_distance_m)) continue;
      const double bound_m =
          least_distance_m(profile.mount.height_m + upper.origin_height_m, lower.elevation_rad,
                           upper.elevation_rad, static_cast<double>(config.max_slope_rad));
      ring_spacing_m_[pair] = static_cast<float>(std::fmax(bound_m, 0.0));
    }
  }
}

float AdjacentPoints::ring_spacing_m(int row, int row_step) const noexcept {
  return ring_spacing_m_[static_cast<std::size_t>((row_step - 1) * shape_.rows + row)];
}

void AdjacentPoints::refine(const RangeImage& image, CellPlanes& planes) noexcept {
  std::fill(planes.steep.begin(), planes.steep.end(), std::uint8_t{0});
  const auto stride = static_cast<std::size_t>(shape_.stride());
  for (int step = config_.first_row_step; step <= config_.last_row_step; ++step) {
    for (int row = 0; row < shape_.rows; ++row) {
      const int upper_row = upper_row_[static_cast<std::size_t>((step - 1) * shape_.rows + row)];
      if (upper_row == shape_.rows) break;  // nor is there one for the rows above
      const std::size_t lower = static_cast<std::size_t>(row) * stride;
      for (int offset = -config_.column_reach; offset <= config_.column_reach; ++offset) {
        mark(image,
             {lower, static_cast<std::size_t>(upper_row) * stride, offset,
              ring_spacing_m(row, step)},
             planes);
      }
    }
  }
  make_obstacles(planes.steep, planes.label);
}

void AdjacentPoints::mark(const RangeImage& image, const RowPair& pair,
                          CellPlanes& planes) const noexcept {
  const auto mark_run = [&](int lower_column, int upper_column, int count) noexcept {
    const std::size_t lower = pair.lower + static_cast<std::size_t>(lower_column);
    const std::size_t upper = pair.upper + static_cast<std::size_t>(upper_column);
    const Run run{&image.x_m()[lower],
                  &image.y_m()[lower],
                  &image.z_m()[lower],
                  &planes.height_m[lower],
                  &image.x_m()[upper],
                  &image.y_m()[upper],
                  &image.z_m()[upper],
                  &planes.height_m[upper],
                  &planes.steep[lower],
                  &planes.steep[upper],
                  count};
    if (config_.rule == AdjacentRule::kSlope) {
      find_steep_steps(run, config_.min_rise_m, config_.min_upper_height_m, tan_max_slope_squared_,
                       steep_pairs_.data());
      mark_steep_steps(run, config_.min_lower_height_m, steep_pairs_.data());
    } else {
      mark_by_ring_spacing(run, pair.bound_m);
    }
  };
  // The columns close to a circle: the pairs beyond the seam are a second, short run.
  const int columns = shape_.columns;
  const int offset = pair.column_offset;
  if (offset >= 0) {
    mark_run(0, offset, columns - offset);
    if (offset > 0) mark_run(columns - offset, 0, offset);
  } else {
    mark_run(-offset, 0, columns + offset);
    mark_run(0, columns + offset, -offset);
  }
}

}  // namespace terracut::pipeline
