// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/azimuth_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/ring_table.hpp"

namespace terracut::cloud {
namespace {

constexpr int kCloudsLookedAt = 3;
/// Points nearer to each other than this are two returns of one firing.
constexpr double kSameFiring_rad = 1e-4;
constexpr double kFewest = 360, kMost = 4500;

}  // namespace

void AzimuthStep::add(std::span<const scan::ScanPoint> points,
                      std::span<const std::int16_t> ring_of_point) {
  if (clouds_ == kCloudsLookedAt) return;
  ++clouds_;
  std::vector<std::pair<std::int16_t, double>> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (ring_of_point[i] == scan::kNoRing) continue;
    places.emplace_back(ring_of_point[i], scan::azimuth_rad(points[i].x_m, points[i].y_m));
  }
  std::ranges::sort(places);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double step_rad = places[i].second - places[i - 1].second;
    if (places[i].first != places[i - 1].first || step_rad < kSameFiring_rad) continue;
    steps_rad_.push_back(static_cast<float>(step_rad));
  }
}

int AzimuthStep::columns() const {
  constexpr int kUsual = frame::ImageShape{}.columns;
  if (steps_rad_.empty()) return kUsual;
  std::vector<float> steps = steps_rad_;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double firings =
      std::clamp(2 * std::numbers::pi / static_cast<double>(*middle), kFewest, kMost);
  if (std::abs(firings / kUsual - 1) < 0.05) return kUsual;
  return static_cast<int>(std::lround(firings));
}

}  // namespace terracut::cloud
