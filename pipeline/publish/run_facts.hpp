// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "calib/mount/mount.hpp"
#include "pipeline/scene/wanted.hpp"

namespace terracut::publish {

/// Facts about a run that an output gets before the first frame.
struct RunFacts {
  std::string sensor;  ///< For messages: "hdl64e at 192.168.1.201, 10.0 Hz, single return".
  int rows = 0;        ///< Rows of the range image; points have rows [0, rows).
  mount::Mount mount{};
  std::int64_t deadline_ns = 0;  ///< From a frame's last packet to its labels; 0: no deadline.
  bool gives_sectors = false;    ///< True if each frame's sectors come before it.
  bool has_road = false;         ///< True if ground that is not road has its own label.
  scene::Wanted found{};         ///< What frames come with.

  /// Names of coordinate frames in ROS' transform tree. Points lie in the vehicle frame
  /// (calib/mount/mount.hpp), which is published as a child of the sensor's frame, not as its
  /// parent: a frame has only one parent, and in a vehicle's tree the sensor's frame already has
  /// one.
  std::string frame_id = "terracut_ground";
  std::string sensor_frame_id = "terracut_lidar";  ///< Sensor's frame; empty: no transform.
};

}  // namespace terracut::publish
