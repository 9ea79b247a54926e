// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>

namespace terracut::scan {

/// The line y = offset + slope * x.
struct FittedLine {
  double slope = 0;
  double offset = 0;
};

struct LinePoint {
  double x, y;
};

/// Fits the line through points with errors in both coordinates, by Deming's method with Cauchy
/// weights (iterated, deterministic): outliers lose their influence, and errors in x do not flatten
/// the line as in a plain regression of y on x. `y_over_x_error` is the ratio of the two standard
/// deviations. At least two points with different x are needed.
[[nodiscard]] FittedLine fit_line(std::span<const LinePoint> points, double y_over_x_error);

}  // namespace terracut::scan
