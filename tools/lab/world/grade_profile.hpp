// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <vector>

namespace terracut::world {

/// The height of a road along its length, as in road design: the grade (rise per metre) is given at
/// knots and is linear between them, so that heights are smooth parabolas. Beyond the ends the
/// grade is constant.
class GradeProfile {
 public:
  struct Knot {
    double s_m = 0;
    double grade = 0;
  };

  /// Makes a road that is level everywhere.
  GradeProfile() = default;
  /// Knots are in ascending order of s_m; without any the road is level. The height is 0 at s = 0.
  explicit GradeProfile(std::span<const Knot> knots);

  [[nodiscard]] double height_m(double s_m) const noexcept;
  [[nodiscard]] double grade(double s_m) const noexcept;
  /// Returns the steepest grade, up or down.
  [[nodiscard]] double steepest() const noexcept;
  /// Returns the greatest change of grade per metre.
  [[nodiscard]] double sharpest_bend_per_m() const noexcept;

 private:
  [[nodiscard]] double height_above_first_m(double s_m) const noexcept;

  struct Point {
    double s_m, grade, height_m;
  };
  std::vector<Point> points_;
  double height_at_zero_m_ = 0;
};

}  // namespace terracut::world
