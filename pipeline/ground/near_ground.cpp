// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/near_ground.hpp"

#include <cmath>

#include "firmware_io/frame/each_return.hpp"

namespace terracut::ground {
namespace {

/// The frame is read in sixths of a revolution: at the nearest range the strip is 30 degrees wide
/// to either side.
constexpr int kSectorsAFrame = 6;

}  // namespace

bool has_near_ground_columns(frame::ColumnRange columns, const frame::ImageShape& shape) noexcept {
  const int half = (shape.columns / kSectorsAFrame + 1) / 2;
  const auto reaches = [&](int begin, int end) noexcept {
    return columns.begin < end && columns.end > begin;
  };
  const int behind = shape.columns / 2;
  return reaches(0, half + 1) || reaches(shape.columns - half, shape.columns) ||
         reaches(behind - half, behind + half + 1);
}

void take_near_ground(const frame::PointPlanes& points, std::span<const float> height_m,
                      const frame::ImageShape& shape, NearGround& ground,
                      float farthest_m) noexcept {
  const int sector = shape.columns / kSectorsAFrame;
  const auto cells = 2 * static_cast<std::size_t>(sector) * static_cast<std::size_t>(shape.rows);
  const int step = static_cast<int>((cells + NearGround::kMostCellsLookedAt - 1) /
                                    NearGround::kMostCellsLookedAt);
  const float *x_m = points.x_m, *y_m = points.y_m, *z_m = points.z_m;
  ground.count = 0;
  for (int row = 0; row < shape.rows; ++row) {
    // Each row begins at another column, so that thinned rows do not all use the same azimuths.
    for (int at = row % step; at < 2 * sector; at += step) {
      const int from_ahead =
          at < sector ? at - sector / 2 : shape.columns / 2 + at - sector * 3 / 2;
      const int column = from_ahead < 0 ? from_ahead + shape.columns : from_ahead;
      const std::size_t cell = shape.cell(row, column);
      if (std::isnan(height_m[cell]) || !is_near_ground_place(x_m[cell], y_m[cell], farthest_m))
        continue;
      if (ground.count == NearGround::kMost) return;
      ground.points[ground.count++] = {x_m[cell], y_m[cell], z_m[cell]};
    }
  }
}

void take_around(const frame::RangeImage& image, NearGround& ground) noexcept {
  const std::size_t step = image.returns() / NearGround::kMost + 1;
  std::size_t next = 0;
  ground.count = 0;
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
    if (next++ % step != 0 || ground.count == NearGround::kMost) return;
    ground.points[ground.count++] = {placed.point.x_m, placed.point.y_m, placed.point.z_m};
  });
}

}  // namespace terracut::ground
