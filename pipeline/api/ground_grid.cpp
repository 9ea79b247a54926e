// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/ground_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "firmware_io/api/points.hpp"

namespace terracut {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kMostCells = 4000;  // along a side

Status check(const GroundGrid::Config& config) {
  const auto is_in = [](double value, double least, double most) {
    return value >= least && value <= most;
  };
  const bool is_possible = is_in(config.cell_m, 0.05, 10) && is_in(config.reach_m, 1, 250) &&
                           is_in(config.longest_gap_m, 0, 50) &&
                           2 * config.reach_m / config.cell_m <= kMostCells;
  if (is_possible) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("a ground grid of cells of {} m, {} m far, over gaps of {} m; expected "
                          "0.05 to 10 m, 1 to 250 m, 0 to 50 m, and at most {} cells a side",
                          config.cell_m, config.reach_m, config.longest_gap_m, kMostCells));
}

}  // namespace

Expected<GroundGrid> GroundGrid::make(const Config& config) {
  if (const Status possible = check(config); !possible) return tl::unexpected(possible.error());
  return made([&] { return GroundGrid(config); });
}

GroundGrid::GroundGrid(const Config& config)
    : config_(config),
      cells_per_m_(static_cast<float>(1 / config.cell_m)),
      size_(static_cast<std::size_t>(std::ceil(2 * config.reach_m / config.cell_m - 1e-6))),
      longest_gap_(static_cast<std::size_t>(config.longest_gap_m / config.cell_m + 1e-6)),
      ground_(size_ * size_),
      other_(size_ * size_),
      between_(size_ * size_),
      height_m_(size_ * size_, kNone),
      slope_deg_(size_ * size_, kNone),
      known_(size_ * size_, GroundKnown::kUnknown) {}

std::size_t GroundGrid::cell_at(float x_m, float y_m) const noexcept {
  const auto reach_m = static_cast<float>(config_.reach_m);
  const float row = (x_m + reach_m) * cells_per_m_, column = (y_m + reach_m) * cells_per_m_;
  const auto end = static_cast<float>(size_);
  const bool is_inside = row >= 0 && row < end && column >= 0 && column < end;
  if (!is_inside) return cells();
  return static_cast<std::size_t>(row) * size_ + static_cast<std::size_t>(column);
}

Status GroundGrid::update(std::span<const Point> points, std::span<const Label> labels,
                          std::span<const float> heights_m) {
  if (labels.size() != points.size() || heights_m.size() != points.size()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} points came with {} labels and {} heights; expected one of each a "
                            "point (Config::heights asks for heights)",
                            points.size(), labels.size(), heights_m.size()));
  }
  sum_up(points, labels, heights_m);
  interpolate();
  find_slopes();
  return {};
}

void GroundGrid::sum_up(std::span<const Point> points, std::span<const Label> labels,
                        std::span<const float> heights_m) noexcept {
  std::ranges::fill(ground_, Sum{});
  std::ranges::fill(other_, Sum{});
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(heights_m[i])) continue;
    const std::size_t cell = cell_at(points[i].x_m, points[i].y_m);
    if (cell == cells()) continue;
    const bool on_ground = is_ground(labels[i]);
    Sum& sum = on_ground ? ground_[cell] : other_[cell];
    sum.height_m += on_ground ? points[i].z_m : points[i].z_m - heights_m[i];
    ++sum.count;
  }
  for (std::size_t cell = 0; cell < cells(); ++cell) {
    const Sum& sum = ground_[cell].count > 0 ? ground_[cell] : other_[cell];
    height_m_[cell] = sum.count > 0 ? static_cast<float>(sum.height_m / sum.count) : kNone;
    known_[cell] = sum.count == 0            ? GroundKnown::kUnknown
                   : ground_[cell].count > 0 ? GroundKnown::kSeen
                                             : GroundKnown::kInterpolated;
  }
}

void GroundGrid::interpolate() noexcept {
  std::ranges::fill(between_, Between{});
  for (std::size_t line = 0; line < size_; ++line) {
    interpolate_line(line * size_, 1);
    interpolate_line(line, size_);
  }
  for (std::size_t cell = 0; cell < cells(); ++cell) {
    if (between_[cell].weight <= 0) continue;
    height_m_[cell] = between_[cell].height_m / between_[cell].weight;
    known_[cell] = GroundKnown::kInterpolated;
  }
}

void GroundGrid::interpolate_line(std::size_t first, std::size_t step) noexcept {
  std::size_t last = size_;  // the last cell with a height; size_: none yet
  for (std::size_t i = 0; i < size_; ++i) {
    const float height_m = height_m_[first + i * step];
    if (std::isnan(height_m)) continue;
    const std::size_t gap = last < size_ ? i - last - 1 : 0;
    if (gap > 0 && gap <= longest_gap_) {
      const float from_m = height_m_[first + last * step];
      const float weight = 1 / static_cast<float>(gap + 1);
      for (std::size_t k = 1; k <= gap; ++k) {
        Between& at = between_[first + (last + k) * step];
        at.height_m += weight * (from_m + (height_m - from_m) * static_cast<float>(k) * weight);
        at.weight += weight;
      }
    }
    last = i;
  }
}

void GroundGrid::find_slopes() noexcept {
  for (std::size_t row = 0; row < size_; ++row) {
    for (std::size_t column = 0; column < size_; ++column) {
      slope_deg_[row * size_ + column] = slope_at(row, column);
    }
  }
}

float GroundGrid::slope_at(std::size_t row, std::size_t column) const noexcept {
  if (known_[row * size_ + column] == GroundKnown::kUnknown) return kNone;
  // The plane of least squares through the cells around that have a height.
  double n = 0, sum_x = 0, sum_y = 0, sum_z = 0;
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  const auto from = [](std::size_t i) { return i == 0 ? i : i - 1; };
  for (std::size_t r = from(row); r <= std::min(row + 1, size_ - 1); ++r) {
    for (std::size_t c = from(column); c <= std::min(column + 1, size_ - 1); ++c) {
      const double z = double{height_m_[r * size_ + c]};
      if (std::isnan(z)) continue;
      const double x = static_cast<double>(r) - static_cast<double>(row);
      const double y = static_cast<double>(c) - static_cast<double>(column);
      n += 1;
      sum_x += x;
      sum_y += y;
      sum_z += z;
      xx += x * x;
      xy += x * y;
      yy += y * y;
      xz += x * z;
      yz += y * z;
    }
  }
  xx -= sum_x * sum_x / n;
  xy -= sum_x * sum_y / n;
  yy -= sum_y * sum_y / n;
  xz -= sum_x * sum_z / n;
  yz -= sum_y * sum_z / n;
  const double determinant = xx * yy - xy * xy;
  if (determinant < 1e-6) return kNone;  // the cells lie in a line
  const double along_x = (xz * yy - yz * xy) / determinant;
  const double along_y = (yz * xx - xz * xy) / determinant;
  const double slope = std::sqrt(along_x * along_x + along_y * along_y) / config_.cell_m;
  return static_cast<float>(std::atan(slope) * 180 / std::numbers::pi);
}

}  // namespace terracut
