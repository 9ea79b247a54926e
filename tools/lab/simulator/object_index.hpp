// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/lab/scenes/scene.hpp"
#include "tools/lab/world/hit.hpp"

namespace terracut::simulator {

/// The objects of a scene around one time and position, sorted by direction, so that a line of
/// sight is tested against only a few of them.
class ObjectIndex {
 public:
  /// `scene` must outlive this object.
  explicit ObjectIndex(const scenes::Scene& scene);

  /// Places all objects as at `time_s` and sorts them as seen from `viewpoint`. Lines cast
  /// afterwards may start up to `window_s` later and up to `reach_m` from the viewpoint.
  void update(double time_s, double window_s, const Eigen::Vector3d& viewpoint, double reach_m);

  /// Returns the first surface on `line` nearer than `limit_m`, `after_s` after the time of
  /// update(). `ray_key` decides which leaf or wire is hit. Any number of threads may call this
  /// between updates.
  [[nodiscard]] std::optional<world::Hit> cast(const world::SightLine& line, double after_s,
                                               std::uint64_t ray_key,
                                               double limit_m) const noexcept;

 private:
  static constexpr int kSectors = 180;

  struct Placed {
    Eigen::Isometry3d T_world_object;
    Eigen::Isometry3d T_object_world;
    Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
    world::BoundingSphere sphere;  ///< Sphere in the world's frame.
  };
  struct Candidate {
    std::uint32_t object = 0;
    double nearest_m = 0;  ///< The least distance from a line's start.
  };

  void place(std::size_t object, double time_s, double window_s);
  void sort_in(std::size_t object, const Eigen::Vector3d& viewpoint, double reach_m);

  const scenes::Scene* scene_;
  std::vector<world::BoundingSphere> spheres_;  ///< Spheres in the objects' frames.
  std::vector<Placed> placed_;
  std::vector<std::vector<Candidate>> sectors_;
};

}  // namespace terracut::simulator
