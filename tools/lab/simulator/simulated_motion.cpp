// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/simulator/simulated_motion.hpp"

#include <cmath>

#include "firmware_io/vehicle/planar_pose.hpp"

namespace terracut::simulator {
namespace {

constexpr double kHalfBase_m = 1.35;
constexpr double kHalfTrack_m = 0.78;

Eigen::Isometry3d pose_on_arc(const scenes::Scene& scene, const scenes::EgoArc& arc,
                              double time_s) {
  const world::Road& road = scene.terrain.road();
  const world::RoadPoint touched{scene.ego_speed_mps * arc.touches_s, scene.ego_d_m};
  const double along_rad = road.heading_rad(touched.s_m);
  const vehicle::PlanarPose at_touch{touched.s_m, road.y_m(touched), std::cos(along_rad),
                                     std::sin(along_rad)};
  const double since_s = time_s - arc.touches_s;
  const vehicle::PlanarPose pose =
      at_touch * vehicle::after_constant_motion(scene.ego_speed_mps, arc.yaw_rate_radps, since_s);
  return world::stand_on(scene.terrain, pose.x_m, pose.y_m,
                         along_rad + arc.yaw_rate_radps * since_s, kHalfBase_m, kHalfTrack_m);
}

}  // namespace

Eigen::Isometry3d ego_pose(const scenes::Scene& scene, double time_s) {
  if (scene.ego_arc) return pose_on_arc(scene, *scene.ego_arc, time_s);
  const world::Road& road = scene.terrain.road();
  const world::RoadPoint place{scene.ego_speed_mps * time_s, scene.ego_d_m};
  return world::stand_on(scene.terrain, place.s_m, road.y_m(place), road.heading_rad(place.s_m),
                         kHalfBase_m, kHalfTrack_m);
}

vehicle::MotionSample ego_motion(const scenes::Scene& scene, double time_s) {
  constexpr double kAround_s = 1e-3;
  const Eigen::Isometry3d moved =
      ego_pose(scene, time_s - kAround_s).inverse() * ego_pose(scene, time_s + kAround_s);
  return {.stamp_ns = 0,
          .speed_mps = moved.translation().x() / (2 * kAround_s),
          .yaw_rate_radps = std::atan2(moved(1, 0), moved(0, 0)) / (2 * kAround_s)};
}

Eigen::Isometry3d mount_pose(const mount::Mount& mount) {
  const mount::RigidTransform T = mount::T_vehicle_lidar(mount);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << T[0], T[1], T[2], T[4], T[5], T[6], T[8], T[9], T[10];
  pose.translation() << T[3], T[7], T[11];
  return pose;
}

}  // namespace terracut::simulator
