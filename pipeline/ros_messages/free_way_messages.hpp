// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "pipeline/free_way/sector.hpp"
#include "pipeline/publish/labelled_frame.hpp"

namespace terracut::ros_messages {

/// The free way in the terms of sensor_msgs/LaserScan: rays counterclockwise, the first about
/// straight behind.
struct WayScan {
  static constexpr float kRangeMin_m = 0, kRangeMax_m = 300;
  float first_rad = 0, step_rad = 0, last_rad = 0;  ///< angle_min, angle_increment, angle_max.
  float turn_s = 0;                                 ///< scan_time: how long the frame took.
  /// To what a vehicle must stop for: the nearest obstacle or, before it, the edge of a drop. As
  /// REP 117 says: infinity if there is neither, NaN if nothing at all was seen.
  std::vector<float> ranges_m;
  std::vector<float> seen_m;  ///< intensities: up to where ground was seen.
};

[[nodiscard]] WayScan way_scan(const publish::LabelledFrame& frame);

/// Writes the sensor_msgs/LaserScan.
void write_free_way_scan(const publish::LabelledFrame& frame, std::string_view frame_id,
                         std::vector<std::byte>& message);
/// Writes free_way::outline() as a geometry_msgs/PolygonStamped.
void write_free_way_polygon(const publish::LabelledFrame& frame, std::string_view frame_id,
                            std::vector<std::byte>& message);
/// Writes a free_way::WayGrid as a nav_msgs/OccupancyGrid.
void write_free_way_grid(const publish::LabelledFrame& frame, std::string_view frame_id,
                         std::vector<std::byte>& message);

}  // namespace terracut::ros_messages
