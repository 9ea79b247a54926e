// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "calib/mount/mount.hpp"
#include "pipeline/objects/object.hpp"
#include "pipeline/publish/labelled_frame.hpp"

namespace terracut::ros_messages {

/// A box in the terms of geometry_msgs.
struct BoxPose {
  std::array<double, 3> middle_m;       ///< geometry_msgs/Point.
  std::array<double, 4> rotation_xyzw;  ///< geometry_msgs/Quaternion; x ahead, w >= 0.
  std::array<double, 3> size_m;         ///< Length, width, height.
};
/// Returns the box of an object, from its lowest to its highest return, in the vehicle frame.
[[nodiscard]] BoxPose box_pose(const objects::Object& object) noexcept;
/// Returns a box of the vehicle frame in another frame.
[[nodiscard]] BoxPose moved(const BoxPose& box, const mount::RigidTransform& T_to_from) noexcept;

/// Lines to be shown as a visualization_msgs/Marker.
struct ObjectLines {
  const char* name;
  std::array<float, 4> rgba;
  std::vector<std::array<double, 3>> places_m;  ///< Pairs of places, which a line joins each.
};
inline constexpr std::int32_t kLineList = 5;  ///< visualization_msgs/Marker::LINE_LIST
inline constexpr double kLineWidth_m = 0.05;
/// Returns the edges of all boxes, and the sides of all footprints, on the ground.
[[nodiscard]] std::array<ObjectLines, 2> object_lines(std::span<const objects::Object> objects);

/// Writes a vision_msgs/Detection3DArray of the frame's objects to `message`, replacing its
/// content: a box for each, with its number in the frame as `id` and no class.
void write_detections(const publish::LabelledFrame& frame, std::string_view frame_id,
                      std::vector<std::byte>& message);

/// Writes a visualization_msgs/MarkerArray of the frame's objects to `message`, replacing its
/// content: one marker with the edges of all boxes, one with all footprints. They replace those of
/// the frame before.
void write_object_markers(const publish::LabelledFrame& frame, std::string_view frame_id,
                          std::vector<std::byte>& message);

}  // namespace terracut::ros_messages
