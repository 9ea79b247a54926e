// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "column_angles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/elevation/ring_elevation_map.hpp"

namespace terracut::baselines {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Mirrors a row index outside the image at the image's edge.
int mirrored(int row, int rows) noexcept {
  if (row < 0) row = -row;
  if (row >= rows) row = 2 * (rows - 1) - row;
  return std::clamp(row, 0, rows - 1);
}

}  // namespace

ColumnAngles::ColumnAngles(const Config& config, const mount::RingProfile&, frame::ImageShape shape,
                           std::size_t return_capacity, memory::FixedMemory& memory)
    : Baseline(stage::Stage::kAdjacentPoints,
               elevation::RingElevationMap::Config().obstacle_height_m, shape, return_capacity,
               memory),
      config_(config),
      shape_(shape),
      filter_(config.smoothing_window),
      range_m_(memory.take<float>("column angles", shape.cells())),
      z_m_(memory.take<float>("column angles", shape.cells())),
      raw_deg_(memory.take<float>("column angles", shape.cells())),
      angle_deg_(memory.take<float>("column angles", shape.cells())),
      ground_(memory.take<std::uint8_t>("column angles", shape.cells())),
      queue_(memory.take<std::uint32_t>("column angles", shape.cells())) {}

void ColumnAngles::label_cells(const frame::RangeImage& image,
                               stage::StageObserver* observer) noexcept {
  repair_columns(image);
  measure_angles();
  smooth_angles();
  spread_ground();
  grow_ground();
  put_labels(image);
  if (observer != nullptr) observer->stage_done(stage::Stage::kAdjacentPoints);
}

void ColumnAngles::repair_columns(const frame::RangeImage& image) noexcept {
  for (std::size_t i = 0; i < range_m_.size(); ++i) {
    const bool seen = image.has_return(i);
    range_m_[i] = seen ? image.ground_range_m()[i] : kNothing;
    z_m_[i] = seen ? image.z_m()[i] : kNothing;
  }
  if (config_.repair_rows == 0) return;
  for (int row = 1; row + 1 < shape_.rows; ++row) {
    for (int column = 0; column < shape_.columns; ++column) {
      if (!image.has_return(cell(row, column))) bridge_hole(image, row, column);
    }
  }
}

/// Fills a hole by interpolation between the nearest returns below and above it.
void ColumnAngles::bridge_hole(const frame::RangeImage& image, int row, int column) noexcept {
  const auto steps_to_return = [&](int direction) noexcept {
    for (int steps = 1; steps <= config_.repair_rows; ++steps) {
      const int other = row + direction * steps;
      if (other < 0 || other >= shape_.rows) return 0;
      if (image.has_return(cell(other, column))) return steps;
    }
    return 0;
  };
  const int down = steps_to_return(-1);
  const int up = down == 0 ? 0 : steps_to_return(1);
  if (up == 0) return;
  const std::size_t lower = cell(row - down, column);
  const std::size_t upper = cell(row + up, column);
  const float away_m = image.ground_range_m()[upper] - image.ground_range_m()[lower];
  const float rise_m = image.z_m()[upper] - image.z_m()[lower];
  if (std::fabs(away_m) >= config_.repair_range_m) return;
  const float share = static_cast<float>(down) / static_cast<float>(down + up);
  range_m_[cell(row, column)] = image.ground_range_m()[lower] + share * away_m;
  z_m_[cell(row, column)] = image.z_m()[lower] + share * rise_m;
}

void ColumnAngles::measure_angles() noexcept {
  constexpr float kDegreesPerRadian = 180.0F / std::numbers::pi_v<float>;
  const auto stride = static_cast<std::size_t>(shape_.stride());
  for (int row = 0; row < shape_.rows; ++row) {
    const bool has_above = row + 1 < shape_.rows;
    for (int column = 0; column < shape_.columns; ++column) {
      const std::size_t here = cell(row, column);
      raw_deg_[here] = kNothing;
      if (std::isnan(range_m_[here])) continue;
      if (has_above && !std::isnan(range_m_[here + stride])) {
        raw_deg_[here] =
            kDegreesPerRadian * std::atan2(std::fabs(z_m_[here + stride] - z_m_[here]),
                                           std::fabs(range_m_[here + stride] - range_m_[here]));
      } else if (row > 0) {
        raw_deg_[here] = raw_deg_[here - stride];  // nothing lies above: uses the line from below
      }
    }
  }
}

void ColumnAngles::smooth_angles() noexcept {
  const auto weights = filter_.weights();
  for (int row = 0; row < shape_.rows; ++row) {
    const auto out = angle_deg_.subspan(cell(row, 0), static_cast<std::size_t>(shape_.columns));
    std::fill(out.begin(), out.end(), 0.0F);
    for (int k = -filter_.reach(); k <= filter_.reach(); ++k) {
      const float weight = weights[static_cast<std::size_t>(k + filter_.reach())];
      const std::size_t from = cell(mirrored(row + k, shape_.rows), 0);
      for (std::size_t column = 0; column < out.size(); ++column) {
        out[column] += weight * raw_deg_[from + column];
      }
    }
    // Windows with holes are not smoothed.
    for (std::size_t column = 0; column < out.size(); ++column) {
      if (std::isnan(out[column])) out[column] = raw_deg_[cell(row, 0) + column];
    }
  }
}

void ColumnAngles::spread_ground() noexcept {
  std::fill(ground_.begin(), ground_.end(), std::uint8_t{0});
  for (int column = 0; column < shape_.columns; ++column) {
    int row = 0;
    while (row < shape_.rows && std::isnan(range_m_[cell(row, column)])) ++row;
    if (row == shape_.rows) continue;
    const std::size_t lowest = cell(row, column);
    if (ground_[lowest] == 0 && angle_deg_[lowest] <= config_.start_deg) {
      spread_from(static_cast<std::uint32_t>(lowest));
    }
  }
}

void ColumnAngles::spread_from(std::uint32_t start) noexcept {
  const auto stride = static_cast<std::uint32_t>(shape_.stride());
  const auto columns = static_cast<std::uint32_t>(shape_.columns);
  const auto cells = static_cast<std::uint32_t>(shape_.cells());
  std::size_t taken = 0, put = 0;
  queue_[put++] = start;
  ground_[start] = 1;
  while (taken < put) {
    const std::uint32_t here = queue_[taken++];
    const std::uint32_t column = here % stride;
    const std::array<std::uint32_t, 4> neighbours{
        here - stride,  // below row 0 this wraps to beyond the image
        here + stride, column == 0 ? here + columns - 1 : here - 1,
        column + 1 == columns ? here + 1 - columns : here + 1};
    for (const std::uint32_t next : neighbours) {
      if (next >= cells || ground_[next] != 0) continue;
      // This is also true for NaN, the angle of a cell without a value.
      if (!(std::fabs(angle_deg_[next] - angle_deg_[here]) < config_.same_ground_deg)) continue;
      ground_[next] = 1;
      queue_[put++] = next;
    }
  }
}

void ColumnAngles::grow_ground() noexcept {
  constexpr std::uint8_t kReached = 1;
  constexpr std::uint8_t kGrown = 2;
  for (int row = 0; row < shape_.rows; ++row) {
    const int last = std::min(shape_.rows - 1, row + config_.margin_rows);
    for (int other = std::max(0, row - config_.margin_rows); other <= last; ++other) {
      for (int column = 0; column < shape_.columns; ++column) {
        std::uint8_t& mark = ground_[cell(other, column)];
        if (mark == 0 && ground_[cell(row, column)] == kReached) mark = kGrown;
      }
    }
  }
}

void ColumnAngles::put_labels(const frame::RangeImage& image) noexcept {
  for (std::size_t i = 0; i < planes_.label.size(); ++i) {
    const bool seen = image.has_return(i);
    const bool ground = ground_[i] != 0;
    planes_.height_m[i] = !seen ? kNothing : ground ? 0.0F : image.z_m()[i];
    planes_.label[i] = !seen    ? frame::Label::kNone
                       : ground ? frame::Label::kGround
                                : frame::Label::kObstacle;
  }
}

}  // namespace terracut::baselines
