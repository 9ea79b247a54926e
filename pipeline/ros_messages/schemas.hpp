// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

namespace terracut::ros_messages {

/// A message type with its definition and the definitions of its parts, in the encoding "ros2msg"
/// of MCAP and Foxglove.
struct Schema {
  std::string_view type;  ///< "sensor_msgs/msg/PointCloud2"
  std::string_view definition;
};

extern const Schema kPointCloud2, kDiagnosticArray, kTfMessage, kDetection3DArray, kMarkerArray,
    kLaserScan, kPolygonStamped, kOccupancyGrid;

}  // namespace terracut::ros_messages
