// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/scene_of_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "firmware_io/frame/azimuths.hpp"

namespace terracut::points {

SceneOfPoints::SceneOfPoints(scene::Wanted wanted, const mount::RingProfile& profile,
                             frame::ImageShape shape, std::size_t most_points)
    : most_points_(most_points),
      image_(shape, most_points, memory_),
      scene_(wanted.without_sight(), profile, shape, most_points, memory_) {
  labels_.reserve(most_points);
}

void SceneOfPoints::find(std::span<const LabelledPoint> points,
                         std::span<const float> heights_m) noexcept {
  points = points.first(std::min(points.size(), most_points_));
  place(points);
  labels_.resize(points.size());
  std::ranges::transform(points, labels_.begin(), &LabelledPoint::label);
  scene_.find(image_, labels_, heights_m);
}

void SceneOfPoints::place(std::span<const LabelledPoint> points) noexcept {
  constexpr std::size_t kBlock = 512;
  std::array<CloudPoint, kBlock> block;
  std::array<float, kBlock> azimuth_rad;
  const auto& [rows, columns] = image_.shape();
  const float columns_per_rad = static_cast<float>(columns) / (2 * std::numbers::pi_v<float>);
  image_.clear();
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const auto some = points.subspan(first, std::min(kBlock, points.size() - first));
    std::ranges::transform(some, block.begin(), [](const LabelledPoint& point) {
      return CloudPoint{point.x_m, point.y_m, point.z_m, 0};
    });
    frame::find_azimuths(std::span(block).first(some.size()), azimuth_rad);
    for (std::size_t i = 0; i < some.size(); ++i) {
      const LabelledPoint& point = some[i];
      const int column =
          std::clamp(static_cast<int>(azimuth_rad[i] * columns_per_rad), 0, columns - 1);
      const int row = std::min(static_cast<int>(point.row), rows - 1);
      // There is room for all points, so the number of a return is that of its point.
      (void)image_.place(row, column,
                         {point.x_m, point.y_m, point.z_m,
                          std::sqrt(point.x_m * point.x_m + point.y_m * point.y_m), 0});
    }
  }
}

}  // namespace terracut::points
