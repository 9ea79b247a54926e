// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>

#include "calib/mount/mount.hpp"
#include "firmware_io/vehicle/motion_sample.hpp"
#include "tools/lab/scenes/scene.hpp"

namespace terracut::simulator {

/// Returns T_world_vehicle of the sensor's vehicle, which drives along the road on four wheels, at
/// a time since the start of the drive (negative: before it).
[[nodiscard]] Eigen::Isometry3d ego_pose(const scenes::Scene& scene, double time_s);

/// Returns the readings of the vehicle's own sensors at that time, without a stamp. The point of
/// the vehicle that does not move sideways is the one below the sensor.
[[nodiscard]] vehicle::MotionSample ego_motion(const scenes::Scene& scene, double time_s);

/// Returns mount::T_vehicle_lidar() as an Eigen transform.
[[nodiscard]] Eigen::Isometry3d mount_pose(const mount::Mount& mount);

}  // namespace terracut::simulator
