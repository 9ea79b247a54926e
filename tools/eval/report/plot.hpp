// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

#include "svg.hpp"

namespace terracut::evaluation::report {

/// The values an axis covers, from < to.
struct AxisRange {
  double from = 0;
  double to = 1;
};

/// [0, to] with `to` a round number >= largest.
[[nodiscard]] AxisRange from_zero(double largest);
/// A round distance between ticks, so that about `wished` of them are in the range.
[[nodiscard]] double tick_step(const AxisRange& range, int wished);

/// An SVG drawing with two linear axes: where values lie in it, and the axes with their ticks. What
/// is drawn goes through svg().
class Plot {
 public:
  /// width x height pixels, axes and their texts included.
  Plot(double width, double height, AxisRange x, AxisRange y, std::string_view alternative);

  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
  [[nodiscard]] Svg& svg() { return svg_; }

  /// Lines across at round values of y, and the text along the axis.
  void y_axis(std::string_view title);
  /// Ticks at round values of x, and the text below.
  void x_axis(std::string_view title);
  /// A text of the x axis at a value of one's own choice, for axes of names.
  void x_label(double value, std::string_view text);

 private:
  static constexpr double kLeft = 56, kRight = 18, kTop = 10, kBottom = 42;

  double width_, height_;
  AxisRange x_, y_;
  Svg svg_;
};

}  // namespace terracut::evaluation::report
