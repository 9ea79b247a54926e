// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/line_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace terracut::scan {
namespace {

constexpr int kIterations = 12;
constexpr double kMinScale = 1e-4;  // smaller residuals count as exact

/// Weighted sums over the points, relative to their weighted mean.
struct Moments {
  double mean_x = 0, mean_y = 0, xx = 0, yy = 0, xy = 0;
};

Moments moments(std::span<const LinePoint> points, std::span<const double> weights) {
  Moments m;
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += weights[i];
    m.mean_x += weights[i] * points[i].x;
    m.mean_y += weights[i] * points[i].y;
  }
  m.mean_x /= total;
  m.mean_y /= total;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x - m.mean_x, y = points[i].y - m.mean_y;
    m.xx += weights[i] * x * x;
    m.yy += weights[i] * y * y;
    m.xy += weights[i] * x * y;
  }
  return m;
}

/// Returns Deming's slope for the ratio `d` of the error variances (y over x), by the formula that
/// avoids cancellation.
double deming_slope(const Moments& m, double d) {
  const double difference = d * m.xx - m.yy;
  const double root = std::sqrt(difference * difference + 4 * d * m.xy * m.xy);
  return difference > 0 ? 2 * d * m.xy / (difference + root) : (root - difference) / (2 * m.xy);
}

}  // namespace

FittedLine fit_line(std::span<const LinePoint> points, double y_over_x_error) {
  std::vector<double> weights(points.size(), 1.0);
  std::vector<double> sizes(points.size());
  FittedLine line;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Moments m = moments(points, weights);
    line.slope = deming_slope(m, y_over_x_error * y_over_x_error);
    line.offset = m.mean_y - line.slope * m.mean_x;
    for (std::size_t i = 0; i < points.size(); ++i) {
      weights[i] = points[i].y - line.offset - line.slope * points[i].x;
      sizes[i] = std::abs(weights[i]);
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double scale = 2 * 1.4826 * *middle + kMinScale;
    for (double& w : weights) w = 1 / (1 + (w / scale) * (w / scale));
  }
  return line;
}

}  // namespace terracut::scan
