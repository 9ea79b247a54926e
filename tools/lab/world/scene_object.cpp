// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scene_object.hpp"

#include <algorithm>

namespace terracut::world {

BoundingSphere bounding_sphere(const SceneObject& object) {
  if (object.shapes.empty()) return {};
  Eigen::AlignedBox3d box;
  for (const Shape& shape : object.shapes) {
    Eigen::Vector3d half = shape.half;
    if (shape.kind == ShapeKind::kPost) half.y() = half.x();
    if (shape.kind == ShapeKind::kWheel) half.z() = half.x();
    box.extend(shape.centre - half);
    box.extend(shape.centre + half);
  }
  return {box.center(), box.diagonal().norm() / 2};
}

Eigen::Isometry3d pose_at(const SceneObject& object, const Terrain& terrain, double time_s) {
  // `place` is the position at time 0, or at the start of the motion if that is later.
  const double moving_s = std::clamp(time_s, object.moves_from_s, object.moves_until_s) -
                          std::max(0.0, object.moves_from_s);
  const RoadPoint place{object.place.s_m + moving_s * object.along_mps,
                        object.place.d_m + moving_s * object.across_mps};
  const Road& road = terrain.road();
  const double x_m = place.s_m;
  const double y_m = road.y_m(place);
  const double heading_rad = road.heading_rad(place.s_m) + object.heading_rad;
  if (object.stance == Stance::kOnWheels) {
    return stand_on(terrain, x_m, y_m, heading_rad, object.half_base_m, object.half_track_m);
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(x_m, y_m, terrain.height_m(x_m, y_m));
  return pose;
}

}  // namespace terracut::world
