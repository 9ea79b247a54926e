// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/sight_of_points.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/points/row_times.hpp"

namespace terracut::points {

SightOfPoints::SightOfPoints(const mount::RingProfile& profile, frame::ImageShape shape,
                             std::size_t most_points, std::span<const float> beam_turns)
    : most_points_(most_points),
      beam_turns_(beam_turns),
      image_(shape, most_points, memory_),
      scene_({.sight = true}, profile, shape, most_points, memory_) {
  labels_.reserve(most_points);
}

void SightOfPoints::look(std::span<const LabelledPoint> points, std::span<const float> heights_m,
                         const frame::FrameInfo& info) noexcept {
  points = points.first(std::min(points.size(), most_points_));
  const bool has_columns = place(points, info);
  labels_.resize(points.size());
  std::ranges::transform(points, labels_.begin(), &LabelledPoint::label);
  scene_.find(image_, labels_, heights_m,
              has_columns && visibility::SightWatch::is_whole(info, image_.shape()));
}

bool SightOfPoints::place(std::span<const LabelledPoint> points,
                          const frame::FrameInfo& info) noexcept {
  const auto& [rows, columns] = image_.shape();
  const FrameTiming timing = FrameTiming::of(info, beam_turns_);
  image_.clear();
  if (!RowTimes::of(0, columns, timing).tells_columns()) return false;
  for (const LabelledPoint& point : points) {
    const int row = std::min(static_cast<int>(point.row), rows - 1);
    const int column = RowTimes::of(row, columns, timing).column_at(point.time_s);
    // There is room for all points, so the number of a return is that of its point.
    (void)image_.place(row, std::clamp(column, 0, columns - 1),
                       {point.x_m, point.y_m, point.z_m,
                        std::sqrt(point.x_m * point.x_m + point.y_m * point.y_m), 0});
  }
  return true;
}

}  // namespace terracut::points
