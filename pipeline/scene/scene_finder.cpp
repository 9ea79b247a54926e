// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scene_finder.hpp"

#include "pipeline/ground/profile.hpp"

namespace terracut::scene {

SceneFinder::Way::Way(const mount::RingProfile& profile, frame::ImageShape shape,
                      memory::FixedMemory& memory)
    : steps(ground::SegmenterConfig{}.adjacent_points,
            ground::SegmenterConfig{}.elevation_map.obstacle_height_m, profile, shape, memory),
      way({}, profile, shape, memory) {}

SceneFinder::SceneFinder(Wanted wanted, const mount::RingProfile& profile, frame::ImageShape shape,
                         std::size_t return_capacity, memory::FixedMemory& memory)
    : planes_(shape, memory) {
  if (wanted.objects) {
    objects_.emplace(objects::ObjectFinder::Config{}, profile, shape, return_capacity, memory);
  }
  if (wanted.free_way) free_way_.emplace(profile, shape, memory);
  if (wanted.sight) sight_.emplace(profile, shape, memory);
}

void SceneFinder::find(const frame::RangeImage& image, const frame::RangeImage& as_measured,
                       std::span<const frame::Label> labels, std::span<const float> heights_m,
                       bool is_whole) noexcept {
  if (objects_) {
    take(image, labels, heights_m);
    objects_->find(image, planes_, labels);
  }
  if (!free_way_ && !sight_) return;
  if (!objects_ || &image != &as_measured) take(as_measured, labels, heights_m);
  if (sight_) sight_->look(as_measured, planes_, is_whole);
  if (!free_way_) return;
  find_steep(as_measured);
  free_way_->way.find(as_measured, planes_, labels);
}

void SceneFinder::take(const frame::RangeImage& image, std::span<const frame::Label> labels,
                       std::span<const float> heights_m) noexcept {
  const std::span<const std::uint32_t> return_index = image.return_index();
  for (std::size_t cell = 0; cell < planes_.label.size(); ++cell) {
    const bool is_there = image.has_return(cell);
    planes_.label[cell] = is_there ? labels[return_index[cell]] : frame::Label::kNone;
    planes_.height_m[cell] = is_there ? heights_m[return_index[cell]] : frame::kNoHeight_m;
  }
}

void SceneFinder::find_steep(const frame::RangeImage& image) noexcept {
  const frame::ColumnRange all{0, image.shape().columns};
  free_way_->steps.reset(all, planes_);
  free_way_->steps.compare(image.points(), all, planes_);
  free_way_->steps.compare_across_seam(image.points(), planes_);
}

}  // namespace terracut::scene
