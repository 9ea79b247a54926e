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

void add_near_ground(const frame::PointPlanes& points, frame::ColumnRange columns,
                     const frame::ImageShape& shape, NearGround& ground,
                     float farthest_m) noexcept {
  const int sector = shape.columns / kSectorsAFrame;
  const auto cells = 2 * static_cast<std::size_t>(sector) * static_cast<std::size_t>(shape.rows);
  const int step = static_cast<int>((cells + NearGround::kMostCellsLookedAt - 1) /
                                    NearGround::kMostCellsLookedAt);
  const float *x_m = points.x_m, *y_m = points.y_m, *z_m = points.z_m;
  for (int column = columns.begin; column < columns.end; ++column) {
    // Columns are numbered from the strip's first one ahead, on to those behind.
    const bool is_ahead = column < shape.columns / 4 || column >= shape.columns - shape.columns / 4;
    const int from_ahead = column < shape.columns / 4 ? column : column - shape.columns;
    const int number =
        is_ahead ? from_ahead + sector / 2 : column - shape.columns / 2 + sector * 3 / 2;
    if (number < 0 || number >= 2 * sector || is_ahead != (number < sector)) continue;
    // Each column begins at another row, so that thinned columns do not all use the same rows.
    for (int row = number % step; row < shape.rows; row += step) {
      const std::size_t cell = shape.cell(row, column);
      if (std::isnan(z_m[cell]) || !is_near_ground_place(x_m[cell], y_m[cell], farthest_m))
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
