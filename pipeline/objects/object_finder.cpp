// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_finder.hpp"

#include <algorithm>

namespace terracut::objects {

ObjectFinder::ObjectFinder(const Config& config, const mount::RingProfile& profile,
                           frame::ImageShape shape, std::size_t return_capacity,
                           memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      reach_(config.gap_m, profile, shape, memory),
      foot_cut_(config.foot, shape, memory),
      clusters_(config.clusters, shape, memory),
      object_of_cluster_(memory.take<std::uint16_t>("objects", shape.cells())),
      outermost_(memory.take<Outermost>("objects", kMostObjects)),
      objects_(memory.take<Object>("objects", kMostObjects)),
      object_of_return_(memory.take<std::uint16_t>("objects", return_capacity)) {}

void ObjectFinder::find(const frame::RangeImage& image, const stage::CellPlanes& planes,
                        std::span<const frame::Label> labels) noexcept {
  const std::span<const Part> parts = foot_cut_.divide(image, planes, reach_);
  clusters_.find(image, parts, planes.height_m, reach_);
  number();
  returns_ = image.returns();
  std::ranges::fill(object_of_return_.first(returns_), std::uint16_t{0});
  measure(image);
  take_overflow(image, parts, labels);
}

void ObjectFinder::number() noexcept {
  const std::span<const Run> runs = clusters_.runs();
  count_ = 0;
  left_out_ = 0;
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    if (runs[i].cluster != i) continue;
    const Cluster& cluster = clusters_.cluster(i);
    object_of_cluster_[i] = 0;
    const bool stands = runs[i].part == Part::kBody ||
                        (!cluster.is_beside_body && cluster.top_m >= config_.least_top_m);
    if (!stands || cluster.cells < config_.fewest_returns) continue;
    if (count_ == kMostObjects) {
      ++left_out_;
      continue;
    }
    object_of_cluster_[i] = static_cast<std::uint16_t>(count_ + 1);
    Object& object = objects_[count_++];
    object = {};
    object.returns = cluster.cells;
    object.bottom_m = cluster.bottom_m;
    object.top_m = cluster.top_m;
  }
}

void ObjectFinder::measure(const frame::RangeImage& image) noexcept {
  const frame::PointPlanes points = image.points();
  const std::span<const std::uint32_t> return_index = image.return_index();
  const std::span<const Run> runs = clusters_.runs();
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const std::uint16_t number = object_of_cluster_[run.cluster];
    if (number == 0) continue;
    Object& object = objects_[number - 1U];
    Outermost& outermost = outermost_[number - 1U];
    if (run.cluster == i) {
      object.first_return = object.last_return = return_index[run.begin];
      outermost.begin(points, run.begin);
    }
    outermost.add(points, run.begin, run.end);
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      const std::uint32_t index = return_index[cell];
      object.first_return = std::min(object.first_return, index);
      object.last_return = std::max(object.last_return, index);
      object_of_return_[index] = number;
    }
  }
  for (std::size_t i = 0; i < count_; ++i) {
    objects_[i].footprint = outermost_[i].footprint(points);
    objects_[i].box = box_around(objects_[i].footprint);
  }
}

void ObjectFinder::take_overflow(const frame::RangeImage& image, std::span<const Part> parts,
                                 std::span<const frame::Label> labels) noexcept {
  for (const frame::OverflowReturn& extra : image.overflow()) {
    if (labels[extra.return_index] != frame::Label::kObstacle) continue;
    const std::uint16_t number = object_near(image, extra, parts);
    if (number == 0) continue;
    object_of_return_[extra.return_index] = number;
    Object& object = objects_[number - 1U];
    ++object.returns;
    object.first_return = std::min(object.first_return, extra.return_index);
    object.last_return = std::max(object.last_return, extra.return_index);
  }
}

std::uint16_t ObjectFinder::object_near(const frame::RangeImage& image,
                                        const frame::OverflowReturn& extra,
                                        std::span<const Part> parts) const noexcept {
  const frame::PointPlanes points = image.points();
  const int row = static_cast<int>(extra.cell) / shape_.stride();
  const int column = static_cast<int>(extra.cell) % shape_.stride();
  float nearest_m2 = config_.gap_m * config_.gap_m;
  std::uint16_t object = 0;
  for (int other_row = std::max(row - 1, 0); other_row <= std::min(row + 1, shape_.rows - 1);
       ++other_row) {
    for (const int aside : {0, -1, 1}) {
      const int other_column = (column + aside + shape_.columns) % shape_.columns;
      const std::size_t other = shape_.cell(other_row, other_column);
      if (parts[other] == Part::kNone) continue;
      const float x_m = points.x_m[other] - extra.point.x_m;
      const float y_m = points.y_m[other] - extra.point.y_m;
      const float z_m = points.z_m[other] - extra.point.z_m;
      const float distance_m2 = x_m * x_m + y_m * y_m + z_m * z_m;
      if (distance_m2 > nearest_m2) continue;
      nearest_m2 = distance_m2;
      object = object_of_cluster_[clusters_.runs()[clusters_.run_of_cell()[other]].cluster];
    }
  }
  return object;
}

}  // namespace terracut::objects
