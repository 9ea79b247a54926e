// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_finder.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace terracut::objects {

namespace {

/// True if one of two returns lies above the other as on a face that is more upright than level.
/// Growth before a body, which slopes up to it, is none.
bool is_face(const frame::PointPlanes& points, std::uint32_t a, std::uint32_t b) noexcept {
  const float up_m = points.z_m[a] - points.z_m[b];
  return distance_squared_m2(points, a, b) <= 2 * up_m * up_m;
}

/// Adds returns to an object, of which `first` and `last` are the lowest and the highest index.
void add(std::uint32_t returns, std::uint32_t first, std::uint32_t last, Object& object) noexcept {
  object.returns += returns;
  object.first_return = std::min(object.first_return, first);
  object.last_return = std::max(object.last_return, last);
}

}  // namespace

ObjectFinder::ObjectFinder(const Config& config, const mount::RingProfile& profile,
                           frame::ImageShape shape, std::size_t return_capacity,
                           memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      reach_(config.gap_m, profile, shape, memory),
      parts_(shape, memory),
      clusters_(shape, shape.cells() / 2, memory),
      nearby_(config.nearby, shape.cells() / 2, shape.cells() / 4, memory),
      object_of_cluster_(memory.take<std::uint16_t>("objects", shape.cells() / 2)),
      object_of_cell_(memory.take<std::uint16_t>("objects", shape.cells())),
      object_of_return_(memory.take<std::uint16_t>("objects", return_capacity)),
      outermost_(memory.take<Outermost>("objects", kMostObjects)),
      objects_(memory.take<Object>("objects", kMostObjects)) {}

void ObjectFinder::find(const frame::RangeImage& image, const stage::CellPlanes& planes,
                        std::span<const frame::Label> labels) noexcept {
  parts_.divide(planes, config_.low_m);
  clusters_.find(image.points(), parts_, planes.height_m, reach_);
  nearby_.join(clusters_);
  number();
  measure(image);
  take_feet(image, planes.height_m);
  take_overflow(image, planes.label, labels);
}

void ObjectFinder::number() noexcept {
  const std::span<const std::uint32_t> first = nearby_.first();
  count_ = 0;
  left_out_ = 0;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    object_of_cluster_[i] = object_of_cluster_[first[i]];
    if (first[i] != i) continue;
    object_of_cluster_[i] = 0;
    const Cluster& whole = nearby_.whole(i);
    if (whole.cells < config_.fewest_returns) continue;
    if (count_ == kMostObjects) {
      ++left_out_;
      continue;
    }
    objects_[count_] = {};
    objects_[count_].first_return = std::numeric_limits<std::uint32_t>::max();
    objects_[count_].bottom_m = whole.extent.bottom_m();
    objects_[count_].top_m = whole.extent.top_m();
    objects_[count_].ground_z_m = whole.extent.most_m[2] - whole.extent.top_m();
    object_of_cluster_[i] = static_cast<std::uint16_t>(++count_);
  }
}

void ObjectFinder::measure(const frame::RangeImage& image) noexcept {
  const frame::PointPlanes points = image.points();
  const std::span<const std::uint32_t> return_index = image.return_index();
  returns_ = image.returns();
  std::ranges::fill(object_of_return_.first(returns_), std::uint16_t{0});
  std::ranges::fill(object_of_cell_, std::uint16_t{0});
  std::uint16_t begun = 0;
  const std::span<const Run> runs = clusters_.runs();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const std::uint16_t number = object_of_cluster_[run.cluster];
    if (number == 0) continue;
    Outermost& outermost = outermost_[number - 1U];
    if (number > begun) {  // objects are numbered in the order of their first runs
      outermost.begin(points, run.begin);
      begun = number;
    }
    outermost.add(points, run, clusters_.extents()[i]);
    std::uint32_t first = return_index[run.begin], last = first;
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      const std::uint32_t index = return_index[cell];
      object_of_cell_[cell] = number;
      object_of_return_[index] = number;
      first = std::min(first, index);
      last = std::max(last, index);
    }
    add(run.end - run.begin, first, last, objects_[number - 1U]);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    objects_[i].footprint = outermost_[i].footprint(points);
    objects_[i].box = box_around(objects_[i].footprint);
  }
}

void ObjectFinder::take_feet(const frame::RangeImage& image,
                             std::span<const float> height_m) noexcept {
  const frame::PointPlanes points = image.points();
  const auto stride = static_cast<std::uint32_t>(shape_.stride());
  for (int row = shape_.rows - 2; row >= 0; --row) {
    const auto begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
    for (std::uint32_t eight = begin; eight < begin + stride; eight += kEightCells) {
      for (std::uint32_t feet = parts_.feet(eight); feet != 0; feet &= feet - 1) {
        const std::uint32_t cell = eight + static_cast<std::uint32_t>(std::countr_zero(feet));
        const std::uint16_t number = object_of_cell_[cell + stride];
        if (number == 0) continue;
        if (height_m[cell] < config_.least_m || !is_face(points, cell, cell + stride)) continue;
        object_of_cell_[cell] = number;
        const std::uint32_t index = image.return_index()[cell];
        object_of_return_[index] = number;
        Object& object = objects_[number - 1U];
        add(1, index, index, object);
        object.bottom_m = std::min(object.bottom_m, height_m[cell]);
      }
    }
  }
}

void ObjectFinder::take_overflow(const frame::RangeImage& image,
                                 std::span<const frame::Label> cell_labels,
                                 std::span<const frame::Label> labels) noexcept {
  for (const frame::OverflowReturn& extra : image.overflow()) {
    if (labels[extra.return_index] != frame::Label::kObstacle) continue;
    const std::uint16_t number = object_near(image, cell_labels, extra);
    if (number == 0) continue;
    object_of_return_[extra.return_index] = number;
    add(1, extra.return_index, extra.return_index, objects_[number - 1U]);
  }
}

std::uint16_t ObjectFinder::object_near(const frame::RangeImage& image,
                                        std::span<const frame::Label> cell_labels,
                                        const frame::OverflowReturn& extra) const noexcept {
  const frame::PointPlanes points = image.points();
  const float farthest_m2 = config_.gap_m * config_.gap_m;
  float nearest_m2 = farthest_m2;
  std::uint16_t object = 0;
  const auto look_at = [&](std::size_t cell) noexcept {
    if (cell_labels[cell] != frame::Label::kObstacle) return;
    const float x_m = points.x_m[cell] - extra.point.x_m;
    const float y_m = points.y_m[cell] - extra.point.y_m;
    const float z_m = points.z_m[cell] - extra.point.z_m;
    const float distance_m2 = x_m * x_m + y_m * y_m + z_m * z_m;
    if (distance_m2 >= nearest_m2) return;
    nearest_m2 = distance_m2;
    object = object_of_cell_[cell];
  };
  look_at(extra.cell);
  if (nearest_m2 < farthest_m2) return object;  // that of the cell's owner
  const int row = static_cast<int>(extra.cell) / shape_.stride();
  const int column = static_cast<int>(extra.cell) % shape_.stride();
  for (int other_row = std::max(row - 1, 0); other_row <= std::min(row + 1, shape_.rows - 1);
       ++other_row) {
    for (const int aside : {0, -1, 1}) {
      look_at(shape_.cell(other_row, (column + aside + shape_.columns) % shape_.columns));
    }
  }
  return object;
}

}  // namespace terracut::objects
