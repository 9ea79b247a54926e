// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/sight_of_points.hpp"

#include <algorithm>

namespace terracut::points {

SightOfPoints::SightOfPoints(const mount::RingProfile& profile, frame::ImageShape shape,
                             std::size_t most_points, std::span<const float> beam_turns)
    : most_points_(most_points),
      image_(shape, most_points, beam_turns, memory_),
      scene_({.sight = true}, profile, shape, most_points, memory_) {
  labels_.reserve(most_points);
}

void SightOfPoints::look(std::span<const LabelledPoint> points, std::span<const float> heights_m,
                         const frame::FrameInfo& info) noexcept {
  points = points.first(std::min(points.size(), most_points_));
  labels_.resize(points.size());
  std::ranges::transform(points, labels_.begin(), &LabelledPoint::label);
  const frame::RangeImage& image = image_.make(info, points);
  scene_.find(image, labels_, heights_m, visibility::SightWatch::is_whole(info, image.shape()));
}

}  // namespace terracut::points
