// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "true_ground.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::statistics {
namespace {

constexpr double kSquare_m = 0.5, kFarthest_m = 100;
constexpr int kSide = static_cast<int>(2 * kFarthest_m / kSquare_m);
constexpr int kReach = 4;  // in squares: 2 m

int square_of(double metres) {
  return static_cast<int>(std::floor((metres + kFarthest_m) / kSquare_m));
}
bool is_inside(int square) {
  return square >= 0 && square < kSide;
}
std::size_t index_of(int x, int y) {
  return static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
}

}  // namespace

TrueGround::TrueGround(const datasets::ClassTable& classes)
    : classes_(classes), squares_(static_cast<std::size_t>(kSide) * kSide) {}

void TrueGround::look_at(const scan::KittiScan& scan) {
  std::ranges::fill(squares_, Square{});
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const scan::ScanPoint& point = scan.points[i];
    if (!scan::is_place(point)) continue;
    const int x = square_of(point.x_m), y = square_of(point.y_m);
    if (!is_inside(x) || !is_inside(y)) continue;
    if (classes_.role(scan::semantic_class(scan.labels[i]), datasets::GroundDefinition::kAll) !=
        datasets::Role::kGround) {
      continue;
    }
    Square& square = squares_[index_of(x, y)];
    square.sum_m += double{point.z_m};
    ++square.points;
  }
}

std::optional<double> TrueGround::height_m(double x_m, double y_m) const {
  const int at_x = square_of(x_m), at_y = square_of(y_m);
  double sum_m = 0, weights = 0;
  for (int y = at_y - kReach; y <= at_y + kReach; ++y) {
    for (int x = at_x - kReach; x <= at_x + kReach; ++x) {
      if (!is_inside(x) || !is_inside(y) || squares_[index_of(x, y)].points == 0) continue;
      const int square_distance = (x - at_x) * (x - at_x) + (y - at_y) * (y - at_y);
      if (square_distance > kReach * kReach) continue;
      const Square& square = squares_[index_of(x, y)];
      const double weight = 1.0 / (1 + square_distance);
      sum_m += weight * square.sum_m / square.points;
      weights += weight;
    }
  }
  if (weights == 0) return std::nullopt;
  return sum_m / weights;
}

}  // namespace terracut::statistics
