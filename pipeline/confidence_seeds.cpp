// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/confidence_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace terracut::pipeline {

namespace {

/// One more than the highest row whose beam meets the ground.
int rows_that_see_ground(const calib::RingProfile& profile) {
  int rows = 0;
  for (std::size_t row = 0; row < profile.rings.size(); ++row) {
    if (std::isfinite(profile.rings[row].ground_distance_m)) rows = static_cast<int>(row) + 1;
  }
  return rows;
}

/// The seed that keeps the label of the stages before.
Seed kept(Label label) noexcept {
  switch (label) {
    case Label::kNone: return Seed::kNone;
    case Label::kGround: return Seed::kGround;
    case Label::kObstacle: return Seed::kObstacle;
  }
  return Seed::kNone;
}

}  // namespace

ConfidenceSeeds::ConfidenceSeeds(const Config& config, const calib::RingProfile& profile,
                                 ImageShape shape, rt::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      cut_rows_(config.rows == CutRows::kAll ? shape.rows : rows_that_see_ground(profile)),
      seeds_(memory.take<Seed>("seeds", shape.cells())),
      ground_in_column_(memory.take<std::uint8_t>(
          "seeds", static_cast<std::size_t>(shape.columns + 2 * config.window_columns))),
      returns_in_column_(memory.take<std::uint8_t>("seeds", ground_in_column_.size())) {}

void ConfidenceSeeds::select(const CellPlanes& planes) noexcept {
  const int window = 2 * config_.window_columns + 1;
  const std::size_t cut_cells =
      static_cast<std::size_t>(cut_rows_) * static_cast<std::size_t>(shape_.stride());
  std::transform(planes.label.begin() + static_cast<std::ptrdiff_t>(cut_cells), planes.label.end(),
                 seeds_.begin() + static_cast<std::ptrdiff_t>(cut_cells), kept);
  for (int row = 0; row < cut_rows_; ++row) {
    count_in_row(planes, row);
    int ground = 0, returns = 0;  // in the window, slid along the row
    for (int i = 0; i < window - 1; ++i) {
      ground += ground_in_column_[static_cast<std::size_t>(i)];
      returns += returns_in_column_[static_cast<std::size_t>(i)];
    }
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.stride());
    for (int column = 0; column < shape_.columns; ++column) {
      const auto entering = static_cast<std::size_t>(column + window - 1);
      ground += ground_in_column_[entering];
      returns += returns_in_column_[entering];
      const std::size_t cell = first + static_cast<std::size_t>(column);
      seeds_[cell] = seed_of(planes, cell, ground, returns);
      ground -= ground_in_column_[static_cast<std::size_t>(column)];
      returns -= returns_in_column_[static_cast<std::size_t>(column)];
    }
  }
}

Seed ConfidenceSeeds::seed_of(const CellPlanes& planes, std::size_t cell, int ground,
                              int returns) const noexcept {
  switch (planes.label[cell]) {
    case Label::kNone: return Seed::kNone;
    case Label::kObstacle: {
      const bool trusted = config_.trust_all_obstacles || planes.steep[cell] != 0 ||
                           planes.height_m[cell] > config_.min_obstacle_height_m;
      return trusted ? Seed::kObstacle : Seed::kUnknown;
    }
    case Label::kGround: {
      const bool trusted =
          static_cast<float>(ground) > config_.ground_share * static_cast<float>(returns) &&
          planes.height_m[cell] < config_.max_ground_height_m;
      return trusted ? Seed::kGround : Seed::kUnknown;
    }
  }
  return Seed::kNone;
}

void ConfidenceSeeds::count_in_row(const CellPlanes& planes, int row) noexcept {
  std::fill(ground_in_column_.begin(), ground_in_column_.end(), std::uint8_t{0});
  std::fill(returns_in_column_.begin(), returns_in_column_.end(), std::uint8_t{0});
  const int reach = config_.window_columns;
  const int last = std::min(shape_.rows - 1, row + config_.window_rows);
  for (int r = std::max(0, row - config_.window_rows); r <= last; ++r) {
    const Label* labels =
        &planes.label[static_cast<std::size_t>(r) * static_cast<std::size_t>(shape_.stride())];
    std::uint8_t* ground = &ground_in_column_[static_cast<std::size_t>(reach)];
    std::uint8_t* returns = &returns_in_column_[static_cast<std::size_t>(reach)];
    for (int column = 0; column < shape_.columns; ++column) {
      ground[column] =
          static_cast<std::uint8_t>(ground[column] + std::uint8_t{labels[column] == Label::kGround});
      returns[column] =
          static_cast<std::uint8_t>(returns[column] + std::uint8_t{labels[column] != Label::kNone});
    }
  }
  const auto wrap = [&](std::span<std::uint8_t> counts) {
    const auto columns = static_cast<std::size_t>(shape_.columns);
    for (std::size_t i = 0; i < static_cast<std::size_t>(reach); ++i) {
      counts[i] = counts[columns + i];
      counts[static_cast<std::size_t>(reach) + columns + i] = counts[static_cast<std::size_t>(reach) + i];
    }
  };
  wrap(ground_in_column_);
  wrap(returns_in_column_);
}

}  // namespace terracut::pipeline
