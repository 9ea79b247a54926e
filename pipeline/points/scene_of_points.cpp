// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/scene_of_points.hpp"

#include <algorithm>

namespace terracut::points {

SceneOfPoints::SceneOfPoints(scene::Wanted wanted, const mount::RingProfile& profile,
                             frame::ImageShape shape, std::size_t most_points,
                             std::span<const float> beam_turns)
    : most_points_(most_points), scene_(wanted, profile, shape, most_points, memory_) {
  if (wanted.objects) image_.emplace(shape, most_points, memory_);
  if (wanted.free_way || wanted.sight)
    as_measured_.emplace(shape, most_points, beam_turns, memory_);
  labels_.reserve(most_points);
}

void SceneOfPoints::find(const frame::FrameInfo& info, std::span<const LabelledPoint> points,
                         std::span<const float> heights_m) noexcept {
  points = points.first(std::min(points.size(), most_points_));
  labels_.resize(points.size());
  std::ranges::transform(points, labels_.begin(), &LabelledPoint::label);
  if (image_) place_by_azimuth(points, *image_);
  const frame::RangeImage* const as_measured =
      as_measured_ ? &as_measured_->make(info, points) : nullptr;
  if (!image_ && as_measured == nullptr) return;
  const frame::RangeImage& image = image_ ? *image_ : *as_measured;
  scene_.find(image, as_measured != nullptr ? *as_measured : image, labels_, heights_m,
              visibility::SightWatch::is_whole(info, image.shape()));
}

}  // namespace terracut::points
