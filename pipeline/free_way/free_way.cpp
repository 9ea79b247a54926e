// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "free_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/stage/row_steps.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::free_way {
namespace {

using frame::Label;

constexpr float kNothing_m = std::numeric_limits<float>::infinity();
/// Ground may fall that steeply from return to return: more than roads do, less than a beam falls
/// into a hole.
constexpr float kSteepestFall = 0.25F;
/// The first ground return may lie so much farther than on level ground, and so much lower, as
/// shares of its distance.
constexpr float kFirstFarther = 0.25F;
constexpr float kFirstLower = 0.06F;

/// The ground before an obstacle is known to about this.
constexpr float kGroundError_m = 0.04F;
/// What is barely high enough may be the ground before something that stands so close behind it.
constexpr float kCloseBehind_m = 1.0F;
/// A return that stands out of its row, without a steep step, may be so much lower.
constexpr float kLower_m = 0.03F;

/// From which heights on returns are obstacles, and up to which.
struct Heights {
  float low_m, low_if_steep_m, high_m, clearance_m;
};

/// A row's cells.
struct Row {
  const float *range_m, *height_m;
  const Label* label;
  const std::uint8_t* steep;
};

/// Makes each column's distances those of the row's obstacles, if they are nearer: of returns that
/// are surely high enough, and of all that may be.
TERRACUT_VECTOR_CLONES void take_nearest(const Heights heights, const Row row, std::size_t columns,
                                         float* __restrict high_m,
                                         float* __restrict low_m) noexcept {
  for (std::size_t i = 0; i < columns; ++i) {
    // Without branches, for vectors.
    const float height_m = row.height_m[i], range_m = row.range_m[i];
    const bool may_stand = (row.label[i] == Label::kObstacle) & (height_m <= heights.clearance_m);
    const bool is_steep = (row.steep[i] & stage::kSteep) != 0;
    const bool is_low = height_m >= (is_steep ? heights.low_if_steep_m : heights.low_m);
    const float high = (may_stand & (height_m >= heights.high_m)) ? range_m : kNothing_m;
    const float low = (may_stand & is_low) ? range_m : kNothing_m;
    high_m[i] = high < high_m[i] ? high : high_m[i];
    low_m[i] = low < low_m[i] ? low : low_m[i];
  }
}

int sectors_of(const FreeWay::Config& config, frame::ImageShape shape) {
  return std::clamp(static_cast<int>(std::lround(360 / config.sector_deg)), 1, shape.columns);
}

}  // namespace

FreeWay::FreeWay(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
                 memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      ground_rows_(stage::rows_that_meet_ground(profile)),
      seen_from_m_(static_cast<float>(profile.rings.front().ground_distance_m)),
      high_m_(config.least_height_m + kGroundError_m),
      obstacle_m_(memory.take<float>("free way", static_cast<std::size_t>(shape.columns))),
      low_obstacle_m_(memory.take<float>("free way", static_cast<std::size_t>(shape.columns))),
      walks_(memory.take<Walk>("free way", static_cast<std::size_t>(shape.columns))),
      first_columns_(
          memory.take<int>("free way", static_cast<std::size_t>(sectors_of(config, shape)) + 1)),
      sectors_(
          memory.take<Sector>("free way", static_cast<std::size_t>(sectors_of(config, shape)))) {
  const int sectors = sectors_of(config, shape);
  for (int i = 0; i <= sectors; ++i) {
    first_columns_[static_cast<std::size_t>(i)] = i * shape.columns / sectors;
  }
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    const frame::ColumnRange columns = columns_of(i);
    const float turns = static_cast<float>(columns.begin + columns.end) /
                        static_cast<float>(2 * shape.columns);  // clockwise
    sectors_[i].azimuth_rad = 2 * std::numbers::pi_v<float> * (turns > 0.5F ? 1 - turns : -turns);
  }
}

void FreeWay::find(const frame::RangeImage& image, const stage::CellPlanes& planes,
                   std::span<const Label> labels) noexcept {
  find_obstacles(image, planes);
  find_second_obstacles(image, planes, labels);
  walk(image, planes);
  join_columns();
}

void FreeWay::find_obstacles(const frame::RangeImage& image,
                             const stage::CellPlanes& planes) noexcept {
  std::ranges::fill(obstacle_m_, kNothing_m);
  std::ranges::fill(low_obstacle_m_, kNothing_m);
  const Heights heights{config_.least_height_m - kLower_m, config_.least_height_m, high_m_,
                        config_.clearance_m};
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t begin = shape_.cell(row, 0);
    take_nearest(heights,
                 {image.points().ground_range_m + begin, &planes.height_m[begin],
                  &planes.label[begin], &planes.steep[begin]},
                 obstacle_m_.size(), obstacle_m_.data(), low_obstacle_m_.data());
  }
  for (std::size_t i = 0; i < obstacle_m_.size(); ++i) {
    if (low_obstacle_m_[i] + kCloseBehind_m < obstacle_m_[i]) obstacle_m_[i] = low_obstacle_m_[i];
  }
}

void FreeWay::find_second_obstacles(const frame::RangeImage& image, const stage::CellPlanes& planes,
                                    std::span<const Label> labels) noexcept {
  for (const frame::OverflowReturn& extra : image.overflow()) {
    if (labels[extra.return_index] != Label::kObstacle) continue;
    // The ground lies as far below the cell's owner as the owner's height says.
    const float above_owner_m = extra.point.z_m - image.z_m()[extra.cell];
    if (!is_in_the_way(planes.height_m[extra.cell] + above_owner_m)) continue;
    float& nearest_m = obstacle_m_[extra.cell % static_cast<std::size_t>(shape_.stride())];
    nearest_m = std::min(nearest_m, extra.point.ground_range_m);
  }
}

float FreeWay::from_m(const Walk& walk) const noexcept {
  return walk.seen_m == 0 ? seen_from_m_ * (1 + kFirstFarther) : walk.seen_m;
}

void FreeWay::walk(const frame::RangeImage& image, const stage::CellPlanes& planes) noexcept {
  std::ranges::fill(walks_, Walk{});
  for (int row = 0; row < ground_rows_; ++row) {
    if (walk_row(row, image, planes) == 0) return;
  }
}

int FreeWay::walk_row(int row, const frame::RangeImage& image,
                      const stage::CellPlanes& planes) noexcept {
  const frame::PointPlanes points = image.points();
  const std::size_t begin = shape_.cell(row, 0);
  const auto columns = static_cast<std::size_t>(shape_.columns);
  int open = 0;
  for (std::size_t i = 0; i < columns; ++i) {
    Walk& walk = walks_[i];
    if (!walk.is_open) continue;
    const std::size_t cell = begin + i;
    const Label label = planes.label[cell];
    if (frame::is_ground(label)) {
      go_on(walk, points.ground_range_m[cell], points.z_m[cell]);
    } else if (label == Label::kObstacle) {
      const bool is_near = points.ground_range_m[cell] <= from_m(walk) + config_.max_gap_m;
      if (is_near && is_in_the_way(planes.height_m[cell])) {
        walk.is_open = false;
        walk.end = SeenEnd::kObstacle;
      }
    } else {
      const std::size_t left = begin + (i == 0 ? columns : i) - 1;
      const std::size_t right = begin + (i + 1 == columns ? 0 : i + 1);
      if (frame::is_ground(planes.label[left]) && frame::is_ground(planes.label[right])) {
        go_on(walk, (points.ground_range_m[left] + points.ground_range_m[right]) / 2,
              (points.z_m[left] + points.z_m[right]) / 2);
      } else {
        walk.has_lost = true;
      }
    }
    open += walk.is_open ? 1 : 0;
  }
  return open;
}

void FreeWay::go_on(Walk& walk, float range_m, float height_m) const noexcept {
  const float by_m = range_m - from_m(walk);
  const float fall_m = walk.height_m - height_m;
  const float most_fall_m = walk.seen_m == 0 ? kFirstLower * range_m : kSteepestFall * by_m;
  if (by_m > config_.max_gap_m) {
    walk.is_open = false;
    walk.end = walk.has_lost ? SeenEnd::kLost : SeenEnd::kRows;
  } else if (fall_m > config_.drop_m && fall_m > most_fall_m) {
    walk.is_open = false;
    walk.end = SeenEnd::kDrop;
  } else {
    walk.seen_m = std::max(walk.seen_m, range_m);
    walk.height_m = height_m;
    walk.has_lost = false;
  }
}

void FreeWay::join_columns() noexcept {
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    Sector sector{.azimuth_rad = sectors_[i].azimuth_rad, .seen_m = kNothing_m};
    const frame::ColumnRange columns = columns_of(i);
    for (auto column = static_cast<std::size_t>(columns.begin);
         column < static_cast<std::size_t>(columns.end); ++column) {
      sector.obstacle_m = std::min(sector.obstacle_m, obstacle_m_[column]);
      if (walks_[column].seen_m < sector.seen_m) {
        sector.seen_m = walks_[column].seen_m;
        sector.seen_end = walks_[column].end;
      }
    }
    sectors_[i] = sector;
  }
}

}  // namespace terracut::free_way
