// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_index.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "tools/lab/world/random.hpp"

namespace terracut::simulator {
namespace {

constexpr double kFarthest_m = 135.0;  // Objects beyond this are ignored.

int sector_of(double azimuth_rad, int sectors) noexcept {
  const double frames = azimuth_rad / (2 * std::numbers::pi);
  const int sector = static_cast<int>((frames - std::floor(frames)) * sectors);
  return std::min(sector, sectors - 1);
}

/// Returns the distance along the line to a hit inside a shape; nothing if the line passes through.
std::optional<double> way_to_leaf_m(const world::Shape& shape, const world::Chord& chord,
                                    std::uint64_t leaf_key) noexcept {
  const double in_m = std::max(chord.in_m, 0.0);
  if (shape.density_per_m == 0) {
    return chord.in_m >= 0 ? std::optional(chord.in_m) : std::nullopt;
  }
  const double depth_m = -std::log(1.0 - world::unit_interval(leaf_key)) / shape.density_per_m;
  return in_m + depth_m < chord.out_m ? std::optional(in_m + depth_m) : std::nullopt;
}

/// Returns an instance number of label files, which have room for 65535; in longer drives numbers
/// come again.
std::uint16_t instance_of(std::uint32_t object, world::Truth truth) noexcept {
  return has_instances(truth) ? static_cast<std::uint16_t>(object % 65535 + 1) : std::uint16_t{0};
}

}  // namespace

ObjectIndex::ObjectIndex(const scenes::Scene& scene)
    : scene_(&scene), placed_(scene.objects.size()), sectors_(kSectors) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    spheres_.push_back(world::bounding_sphere(scene.objects[i]));
    if (!scene.objects[i].moves()) place(i, 0, 0);
  }
}

void ObjectIndex::place(std::size_t object, double time_s, double window_s) {
  const world::SceneObject& source = scene_->objects[object];
  Placed& placed = placed_[object];
  placed.T_world_object = world::pose_at(source, scene_->terrain, time_s);
  placed.T_object_world = placed.T_world_object.inverse();
  placed.sphere = {placed.T_world_object * spheres_[object].centre, spheres_[object].radius_m};
  placed.velocity_mps.setZero();
  if (source.moves() && window_s > 0) {
    const Eigen::Isometry3d later = world::pose_at(source, scene_->terrain, time_s + window_s);
    placed.velocity_mps = (later.translation() - placed.T_world_object.translation()) / window_s;
    placed.sphere.radius_m += placed.velocity_mps.norm() * window_s;
  }
}

void ObjectIndex::sort_in(std::size_t object, const Eigen::Vector3d& viewpoint, double reach_m) {
  const world::BoundingSphere& sphere = placed_[object].sphere;
  const Eigen::Vector3d towards = sphere.centre - viewpoint;
  const double level_m = std::hypot(towards.x(), towards.y());
  const double radius_m = sphere.radius_m + reach_m;
  if (level_m - radius_m > kFarthest_m) return;
  const Candidate candidate{static_cast<std::uint32_t>(object),
                            std::max(0.0, towards.norm() - radius_m)};
  int first = 0;
  int count = kSectors;
  if (level_m > radius_m) {
    const double middle_rad = std::atan2(towards.y(), towards.x());
    const double half_rad = std::asin(radius_m / level_m);
    first = sector_of(middle_rad - half_rad, kSectors);
    const int last = sector_of(middle_rad + half_rad, kSectors);
    count = (last - first + kSectors) % kSectors + 1;
  }
  for (int i = 0; i < count; ++i) {
    sectors_[static_cast<std::size_t>((first + i) % kSectors)].push_back(candidate);
  }
}

void ObjectIndex::update(double time_s, double window_s, const Eigen::Vector3d& viewpoint,
                         double reach_m) {
  for (std::vector<Candidate>& sector : sectors_) sector.clear();
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (scene_->objects[i].moves()) place(i, time_s, window_s);
    sort_in(i, viewpoint, reach_m);
  }
  for (std::vector<Candidate>& sector : sectors_) {
    std::ranges::sort(sector, {}, [](const Candidate& candidate) {
      return std::pair(candidate.nearest_m, candidate.object);
    });
  }
}

std::optional<world::Hit> ObjectIndex::cast(const world::SightLine& line, double after_s,
                                            std::uint64_t ray_key, double limit_m) const noexcept {
  std::optional<world::Hit> nearest;
  const double azimuth_rad = std::atan2(line.direction.y(), line.direction.x());
  const auto sector = static_cast<std::size_t>(sector_of(azimuth_rad, kSectors));
  for (const Candidate& candidate : sectors_[sector]) {
    if (candidate.nearest_m > limit_m) break;
    const Placed& placed = placed_[candidate.object];
    const Eigen::Vector3d from = line.origin - placed.velocity_mps * after_s;
    const Eigen::Vector3d to_centre = placed.sphere.centre - from;
    const double along_m = to_centre.dot(line.direction);
    const double aside2 = to_centre.squaredNorm() - along_m * along_m;
    const double radius_m = placed.sphere.radius_m;
    if (aside2 > radius_m * radius_m || along_m < -radius_m) continue;

    const world::SightLine local{placed.T_object_world * from,
                                 placed.T_object_world.linear() * line.direction};
    const world::SceneObject& object = scene_->objects[candidate.object];
    for (std::size_t i = 0; i < object.shapes.size(); ++i) {
      const world::Shape& shape = object.shapes[i];
      const std::optional<world::Chord> chord = world::intersect(shape, local);
      if (!chord || chord->in_m >= limit_m || chord->out_m <= 0) continue;
      const std::uint64_t leaf_key = world::mix_keys(ray_key, world::mix_keys(object.key, i));
      const std::optional<double> way_m = way_to_leaf_m(shape, *chord, leaf_key);
      if (!way_m || *way_m >= limit_m) continue;
      limit_m = *way_m;
      // Leaves and wires have random directions, so they are assumed to face the beam.
      const Eigen::Vector3d normal = shape.density_per_m > 0
                                         ? Eigen::Vector3d(-line.direction)
                                         : placed.T_world_object.linear() * chord->normal;
      nearest = world::Hit{limit_m, normal, shape.truth, shape.material,
                           instance_of(candidate.object, shape.truth)};
    }
  }
  return nearest;
}

}  // namespace terracut::simulator
