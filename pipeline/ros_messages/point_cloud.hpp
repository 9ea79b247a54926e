// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "pipeline/output/label_sink.hpp"
#include "pipeline/publish/labelled_frame.hpp"

namespace terracut::ros_messages {

/// A point in our clouds, packed in memory: the names and types of ROS' drivers (x, y, z,
/// intensity, ring, time), which the point types of PCL and of LIO packages expect, and our label.
struct CloudPoint {
  float x_m = 0, y_m = 0, z_m = 0;  ///< Vehicle frame (calib/mount/mount.hpp).
  float intensity = 0;              ///< 0 to 255.
  std::uint16_t ring = 0;           ///< Row of the range image, 0 is the lowest laser.
  std::uint8_t label = 0;           ///< SemanticKITTI class, as in .label files.
  std::uint8_t unused = 0;
  float time_s = 0;  ///< Time of measurement after the header's stamp; may be negative.
};
static_assert(sizeof(CloudPoint) == 24);

/// Describes a field of CloudPoint in the terms of sensor_msgs/PointField.
struct CloudField {
  std::string_view name;
  std::uint32_t offset;
  std::uint8_t datatype;
};
inline constexpr std::uint8_t kUint8 = 2, kUint16 = 4, kFloat32 = 7;  ///< Constants of PointField.
inline constexpr CloudField kCloudFields[]{{"x", offsetof(CloudPoint, x_m), kFloat32},
                                           {"y", offsetof(CloudPoint, y_m), kFloat32},
                                           {"z", offsetof(CloudPoint, z_m), kFloat32},
                                           {"intensity", offsetof(CloudPoint, intensity), kFloat32},
                                           {"ring", offsetof(CloudPoint, ring), kUint16},
                                           {"label", offsetof(CloudPoint, label), kUint8},
                                           {"time", offsetof(CloudPoint, time_s), kFloat32}};

/// The field behind a CloudPoint where points come with their heights above the ground, metres.
inline constexpr CloudField kHeightField{"height_above_ground", sizeof(CloudPoint), kFloat32};
/// Returns the bytes of a point of our clouds.
[[nodiscard]] constexpr std::size_t point_bytes(bool with_height) noexcept {
  return sizeof(CloudPoint) + (with_height ? sizeof(float) : 0);
}

/// The choice of a frame's points that a cloud holds.
enum class CloudOf : std::uint8_t { kAll, kGround, kObstacles, kRoad };

/// True if points of this label belong to the cloud. Road is a part of the ground, or all of it if
/// road is not labelled apart.
[[nodiscard]] constexpr bool belongs_to(CloudOf which, frame::Label label) noexcept {
  switch (which) {
    case CloudOf::kAll:
      return true;
    case CloudOf::kGround:
      return frame::is_ground(label);
    case CloudOf::kObstacles:
      return label == frame::Label::kObstacle;
    case CloudOf::kRoad:
      return label == frame::Label::kGround;
  }
  return false;
}

/// `time_of_first_s` is the time of the frame's first packet relative to the header's stamp.
[[nodiscard]] constexpr CloudPoint cloud_point(const points::LabelledPoint& point,
                                               float time_of_first_s) noexcept {
  return {.x_m = point.x_m,
          .y_m = point.y_m,
          .z_m = point.z_m,
          .intensity = static_cast<float>(point.intensity),
          .ring = point.row,
          .label = static_cast<std::uint8_t>(output::semantic_kitti_class(point.label)),
          .unused = 0,
          .time_s = point.time_s + time_of_first_s};
}

/// Writes the points that `which` selects to `to`, in order of arrival, each with its height if
/// there are `heights_m`, one per point. `to` must have room for all points. Returns how many bytes
/// were written.
std::size_t copy_points(CloudOf which, std::span<const points::LabelledPoint> points,
                        std::span<const float> heights_m, float time_of_first_s,
                        std::span<std::byte> to) noexcept;

/// Places, heights and times of points in messages are multiples of these. What they leave out no
/// sensor tells apart, and it would make recordings half as large again.
inline constexpr float kPlaceStep_m = 0x1p-10F;
inline constexpr float kTimeStep_s = 0x1p-17F;  ///< 7.6 microseconds.

/// Writes a sensor_msgs/PointCloud2 of the points that `which` selects, in order of arrival, to
/// `message`, replacing the content of `message`. Places within 4 km, heights and times are
/// rounded. Points have kHeightField if the frame has heights.
void write_point_cloud(const publish::LabelledFrame& frame, CloudOf which,
                       std::string_view frame_id, std::vector<std::byte>& message);

}  // namespace terracut::ros_messages
