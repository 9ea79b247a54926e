// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "calib/mount/mount.hpp"

namespace terracut::publish {

/// What an output is told of a run before its first frame.
struct RunFacts {
  std::string sensor;  ///< For people: "hdl64e at 192.168.1.201, 10.0 Hz, single return".
  int rows = 0;        ///< Of the range image; points have rows [0, rows).
  mount::Mount mount{};
  std::int64_t deadline_ns = 0;  ///< From a frame's last packet to its labels; 0: there is none.
  bool has_road = false;         ///< Ground that is no road has a label of its own.

  /// Names of coordinate frames in ROS' tree of transforms. Points lie in the vehicle frame
  /// (calib/mount/mount.hpp), whose place is told below the sensor's, because that one has a parent
  /// in a vehicle's tree and a frame has one parent only.
  std::string frame_id = "terracut_ground";
  std::string sensor_frame_id = "terracut_lidar";  ///< Empty: no transform is published.
};

}  // namespace terracut::publish
