// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>

#include "calib/mount.hpp"
#include "firmware_io/motion/motion_sample.hpp"
#include "firmware_io/simulator/scene.hpp"

namespace terracut::firmware_io {

/// T_world_vehicle of the sensor's vehicle, which drives along the road and stands on it with four
/// wheels, at a time since the start of the drive (negative times are before it).
[[nodiscard]] Eigen::Isometry3d ego_pose(const Scene& scene, double time_s);

/// What the vehicle's own sensors say at that time; no stamp. The point that does not slip sideways
/// is the one below the sensor.
[[nodiscard]] MotionSample ego_motion(const Scene& scene, double time_s);

/// calib::T_vehicle_lidar() as a transform of this room.
[[nodiscard]] Eigen::Isometry3d mount_pose(const calib::Mount& mount);

}  // namespace terracut::firmware_io
