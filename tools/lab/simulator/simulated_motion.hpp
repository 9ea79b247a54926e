// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>

#include "calib/mount/mount.hpp"
#include "firmware_io/vehicle/motion_sample.hpp"
#include "tools/lab/scenes/scene.hpp"

namespace terracut::simulator {

/// T_world_vehicle of the sensor's vehicle, which drives along the road and stands on it with four
/// wheels, at a time since the start of the drive (negative times are before it).
[[nodiscard]] Eigen::Isometry3d ego_pose(const scenes::Scene& scene, double time_s);

/// What the vehicle's own sensors say at that time; no stamp. The point that does not slip sideways
/// is the one below the sensor.
[[nodiscard]] vehicle::MotionSample ego_motion(const scenes::Scene& scene, double time_s);

/// mount::T_vehicle_lidar() as a transform of this room.
[[nodiscard]] Eigen::Isometry3d mount_pose(const mount::Mount& mount);

}  // namespace terracut::simulator
