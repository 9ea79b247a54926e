// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "grade_profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace terracut::world {

GradeProfile::GradeProfile(std::span<const Knot> knots) {
  double height_m = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (i > 0) {
      const double length_m = knots[i].s_m - knots[i - 1].s_m;
      height_m += length_m * (knots[i].grade + knots[i - 1].grade) / 2;
    }
    points_.push_back({knots[i].s_m, knots[i].grade, height_m});
  }
  height_at_zero_m_ = height_above_first_m(0);
}

double GradeProfile::height_above_first_m(double s_m) const noexcept {
  if (points_.empty()) return 0;
  std::size_t next = 0;
  while (next < points_.size() && points_[next].s_m <= s_m) ++next;
  const Point& from = points_[next == 0 ? 0 : next - 1];
  const double way_m = s_m - from.s_m;
  if (next == 0 || next == points_.size()) return from.height_m + way_m * from.grade;
  const Point& to = points_[next];
  const double bend = (to.grade - from.grade) / (to.s_m - from.s_m);
  return from.height_m + way_m * (from.grade + way_m * bend / 2);
}

double GradeProfile::height_m(double s_m) const noexcept {
  return height_above_first_m(s_m) - height_at_zero_m_;
}

double GradeProfile::grade(double s_m) const noexcept {
  if (points_.empty()) return 0;
  std::size_t next = 0;
  while (next < points_.size() && points_[next].s_m <= s_m) ++next;
  if (next == 0) return points_.front().grade;
  if (next == points_.size()) return points_.back().grade;
  const Point& from = points_[next - 1];
  const Point& to = points_[next];
  return from.grade + (to.grade - from.grade) * (s_m - from.s_m) / (to.s_m - from.s_m);
}

double GradeProfile::steepest() const noexcept {
  double steepest = 0;
  for (const Point& point : points_) steepest = std::max(steepest, std::abs(point.grade));
  return steepest;
}

double GradeProfile::sharpest_bend_per_m() const noexcept {
  double sharpest = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double bend =
        (points_[i].grade - points_[i - 1].grade) / (points_[i].s_m - points_[i - 1].s_m);
    sharpest = std::max(sharpest, std::abs(bend));
  }
  return sharpest;
}

}  // namespace terracut::world
