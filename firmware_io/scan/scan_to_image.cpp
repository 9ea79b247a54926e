// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/scan_to_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "firmware_io/frame/azimuths.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::scan {
namespace {

/// Points are processed in blocks that stay in the cache next to the core.
constexpr std::size_t kBlock = 512;

/// A block's points in the vehicle frame and their cells in the image. Points without a place in
/// the image have arbitrary values.
struct Block {
  std::array<float, kBlock> x_m, y_m, z_m, ground_range_m, azimuth_rad;
  std::array<std::int32_t, kBlock> column;
};

TERRACUT_VECTOR_CLONES void move(const mount::RigidTransform& T, const ScanPoint* __restrict points,
                                 std::size_t count, Block& block) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const double px = double{points[i].x_m}, py = double{points[i].y_m}, pz = double{points[i].z_m};
    const double x = T[0] * px + T[1] * py + T[2] * pz + T[3];
    const double y = T[4] * px + T[5] * py + T[6] * pz + T[7];
    const double z = T[8] * px + T[9] * py + T[10] * pz + T[11];
    block.x_m[i] = static_cast<float>(x);
    block.y_m[i] = static_cast<float>(y);
    block.z_m[i] = static_cast<float>(z);
    block.ground_range_m[i] = static_cast<float>(std::sqrt(x * x + y * y));
  }
}

TERRACUT_VECTOR_CLONES void find_columns(float columns_per_rad, int last_column, std::size_t count,
                                         Block& block) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float azimuth_rad = block.azimuth_rad[i] >= 0 ? block.azimuth_rad[i] : 0.0F;  // no NaN
    const auto column = static_cast<std::int32_t>(azimuth_rad * columns_per_rad);
    block.column[i] = column < last_column ? column : last_column;
  }
}

void turn_over(std::span<const ScanPoint> points, std::span<ScanPoint> turned) noexcept {
  for (std::size_t i = 0; i < points.size(); ++i) {
    turned[i] = points[i];
    turned[i].y_m = -points[i].y_m;
  }
}

}  // namespace

ScanToImage::ScanToImage(const mount::Mount& mount)
    : T_vehicle_lidar_(mount::T_vehicle_lidar(mount)),
      is_upside_down_(mount::is_upside_down(mount)) {}

void ScanToImage::reserve(std::size_t points) {
  point_of_return_.reserve(points);
  label_without_return_.reserve(points);
}

ScanToImage::Summary ScanToImage::place(std::span<const ScanPoint> points,
                                        std::span<const std::int16_t> ring_of_point,
                                        frame::RangeImage& image) {
  Summary summary;
  image.clear();
  point_of_return_.resize(points.size());
  label_without_return_.assign(points.size(), frame::Label::kObstacle);
  const int rows = image.shape().rows, columns = image.shape().columns;
  const float columns_per_rad = static_cast<float>(columns / (2 * std::numbers::pi));
  Block block;
  std::array<ScanPoint, kBlock> turned;
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - first);
    move(T_vehicle_lidar_, &points[first], count, block);
    if (is_upside_down_) {
      turn_over(points.subspan(first, count), turned);
      frame::find_azimuths(std::span(turned).first(count), block.azimuth_rad);
    } else {
      frame::find_azimuths(points.subspan(first, count), block.azimuth_rad);
    }
    find_columns(columns_per_rad, columns - 1, count, block);
    for (std::size_t i = 0; i < count; ++i) {
      const ScanPoint& p = points[first + i];
      const std::int16_t ring = ring_of_point[first + i];
      if (ring == kNoRing) [[unlikely]] {
        const bool place = is_place(p);
        ++(place ? summary.no_ring : summary.no_place);
        if (!place) label_without_return_[first + i] = frame::Label::kNone;
        continue;
      }
      const frame::Return point{block.x_m[i], block.y_m[i], block.z_m[i], block.ground_range_m[i],
                                intensity_of(p.remission)};
      if (!image.place(is_upside_down_ ? ring : rows - 1 - ring, block.column[i], point,
                       frame::CellOwner::kNearest)) {
        ++summary.overflow_full;
        continue;
      }
      point_of_return_[summary.placed++] = static_cast<std::uint32_t>(first + i);
    }
  }
  point_of_return_.resize(summary.placed);
  return summary;
}

void ScanToImage::labels_of_points(std::span<const frame::Label> of_returns,
                                   std::vector<frame::Label>& of_points) const {
  of_points.assign(label_without_return_.begin(), label_without_return_.end());
  const std::size_t returns = std::min(of_returns.size(), point_of_return_.size());
  for (std::size_t i = 0; i < returns; ++i) of_points[point_of_return_[i]] = of_returns[i];
}

}  // namespace terracut::scan
