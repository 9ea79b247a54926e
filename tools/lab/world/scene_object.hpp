// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "road.hpp"
#include "shapes.hpp"
#include "terrain.hpp"

namespace terracut::world {

/// The pose of an object on the ground.
enum class Stance : std::uint8_t {
  kUpright,   ///< z straight up, origin on the ground: people, trees, poles, buildings.
  kOnWheels,  ///< Follows the slope of the ground below its base.
};

/// An object of the world: shapes that move together along the road.
struct SceneObject {
  std::vector<Shape> shapes;
  Stance stance = Stance::kUpright;
  double half_base_m = 1.0;  ///< Half the wheel base and track; for kOnWheels only.
  double half_track_m = 0.5;
  RoadPoint place;         ///< Position at time 0, or until moves_from_s.
  std::uint64_t key = 0;   ///< Key of its random numbers (which leaf is hit).
  double heading_rad = 0;  ///< Angle to the left of the road's direction at that place.
  double along_mps = 0;    ///< Speed along the road and to its left, while it moves.
  double across_mps = 0;
  /// Before and after these times the object stands still.
  double moves_from_s = -std::numeric_limits<double>::infinity();
  double moves_until_s = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool moves() const noexcept { return along_mps != 0 || across_mps != 0; }
};

/// A sphere around all shapes, in the object's frame.
struct BoundingSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

[[nodiscard]] BoundingSphere bounding_sphere(const SceneObject& object);

/// Returns T_world_object at a time since the start of the drive.
[[nodiscard]] Eigen::Isometry3d pose_at(const SceneObject& object, const Terrain& terrain,
                                        double time_s);

}  // namespace terracut::world
