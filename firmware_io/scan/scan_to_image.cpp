// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/scan_to_image.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware_io/scan/ring_table.hpp"

namespace terracut::scan {

ScanToImage::ScanToImage(const mount::Mount& mount)
    : T_vehicle_lidar_(mount::T_vehicle_lidar(mount)) {}

ScanToImage::Summary ScanToImage::place(std::span<const ScanPoint> points,
                                        std::span<const std::int16_t> ring_of_point,
                                        frame::RangeImage& image) {
  Summary summary;
  image.clear();
  point_of_return_.clear();
  label_without_return_.assign(points.size(), frame::Label::kObstacle);
  const int rows = image.shape().rows, columns = image.shape().columns;
  const double columns_per_rad = columns / (2 * std::numbers::pi);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ScanPoint& p = points[i];
    if (!is_place(p)) {
      ++summary.no_place;
      label_without_return_[i] = frame::Label::kNone;
      continue;
    }
    if (ring_of_point[i] == kNoRing) {
      ++summary.no_ring;
      continue;
    }
    const auto [x, y, z] = mount::apply(T_vehicle_lidar_, p.x_m, p.y_m, p.z_m);
    const frame::Return point{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
                              static_cast<float>(std::sqrt(x * x + y * y)),
                              intensity_of(p.remission)};
    const int column =
        std::min(static_cast<int>(azimuth_rad(p.x_m, p.y_m) * columns_per_rad), columns - 1);
    if (!image.place(rows - 1 - ring_of_point[i], column, point)) {
      ++summary.overflow_full;
      continue;
    }
    point_of_return_.push_back(static_cast<std::uint32_t>(i));
  }
  summary.placed = point_of_return_.size();
  return summary;
}

void ScanToImage::labels_of_points(std::span<const frame::Label> of_returns,
                                   std::vector<frame::Label>& of_points) const {
  of_points.assign(label_without_return_.begin(), label_without_return_.end());
  const std::size_t returns = std::min(of_returns.size(), point_of_return_.size());
  for (std::size_t i = 0; i < returns; ++i) of_points[point_of_return_[i]] = of_returns[i];
}

}  // namespace terracut::scan
