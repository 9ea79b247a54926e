// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "firmware_io/scan/ring_table_fit.hpp"

namespace terracut::cloud {
namespace {

using scan::ScanPoint;

/// False for the points that drivers write where a beam had no return: null or not finite.
bool is_measured(const ScanPoint& p) noexcept {
  const bool is_null = p.x_m == 0 && p.y_m == 0 && p.z_m == 0;
  return !is_null && std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.z_m);
}

double distance_m(const ScanPoint& p) noexcept {
  return std::hypot(double{p.x_m}, double{p.y_m}, double{p.z_m});
}

/// Returns the quantile `share` (0.5: the median) of `figure` over the points.
template <class Figure>
double quantile(std::span<const ScanPoint> points, double share, Figure&& figure) {
  std::vector<double> values;
  for (const ScanPoint& p : points) values.push_back(figure(p));
  const double place = share * static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(values, at);
  return *at;
}

/// Guesses, for a message, why measured points lie too far away.
std::string_view likely_cause(std::span<const ScanPoint> points) {
  // If the bytes are not floats of this layout, the numbers they give may have any size.
  constexpr double kNoCoordinates = 1e6;
  if (quantile(points, 0.9, distance_m) > kNoCoordinates * quantile(points, 0.1, distance_m)) {
    return "are these bytes of another layout, or big-endian?";
  }
  // The points of a sensor lie around it; map coordinates lie far to one side.
  const double middle_x = quantile(points, 0.5, [](const ScanPoint& p) { return double{p.x_m}; });
  const double middle_y = quantile(points, 0.5, [](const ScanPoint& p) { return double{p.y_m}; });
  const double spread = quantile(points, 0.5, [&](const ScanPoint& p) {
    return std::hypot(double{p.x_m} - middle_x, double{p.y_m} - middle_y);
  });
  if (std::hypot(middle_x, middle_y) > 3 * spread) return "are these coordinates of a map?";
  // In a street the median distance is 10 m: 1000 in centimetres, 10000 in millimetres.
  constexpr double kHalfWayInLogarithms = 3000;
  return quantile(points, 0.5, distance_m) > kHalfWayInLogarithms ? "are these millimetres?"
                                                                  : "are these centimetres?";
}

}  // namespace

Status check_reach(std::span<const ScanPoint> points) {
  constexpr double kReach_m = scan::RingTableFit::kReach_m;
  constexpr std::size_t kFewestToTell = 20;  // with fewer points, most of them may be stray ones
  std::size_t beyond = 0, all = 0;
  for (const ScanPoint& p : points) {
    if (!is_measured(p)) continue;
    const double x = double{p.x_m}, y = double{p.y_m}, z = double{p.z_m};
    ++all;
    beyond += x * x + y * y + z * z > kReach_m * kReach_m ? 1U : 0U;
  }
  if (all < kFewestToTell || 2 * beyond <= all) return {};
  std::vector<ScanPoint> measured;
  std::ranges::copy_if(points, std::back_inserter(measured), is_measured);
  return fail(ErrorCode::kMalformed,
              fmt::format("{} of {} points are farther than {:.0f} m from the origin: {} Expected "
                          "are metres in the sensor's own frame",
                          beyond, all, kReach_m, likely_cause(measured)));
}

}  // namespace terracut::cloud
