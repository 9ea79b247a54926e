// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/simulator/ego_motion.hpp"

namespace terracut::firmware_io {
namespace {

constexpr double kHalfBase_m = 1.35;
constexpr double kHalfTrack_m = 0.78;

}  // namespace

Eigen::Isometry3d ego_pose(const Scene& scene, double time_s) {
  const Road& road = scene.terrain.road();
  const RoadPoint place{scene.ego_speed_mps * time_s, scene.ego_d_m};
  return stand_on(scene.terrain, place.s_m, road.y_m(place), road.heading_rad(place.s_m),
                  kHalfBase_m, kHalfTrack_m);
}

Eigen::Isometry3d mount_pose(const calib::Mount& mount) {
  const calib::RigidTransform T = calib::T_vehicle_lidar(mount);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << T[0], T[1], T[2], T[4], T[5], T[6], T[8], T[9], T[10];
  pose.translation() << T[3], T[7], T[11];
  return pose;
}

}  // namespace terracut::firmware_io
