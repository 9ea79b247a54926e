// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/object_messages.hpp"

#include <cmath>
#include <string>

#include "calib/mount/mount_pose.hpp"
#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {
namespace {

using objects::Object;
using Place = std::array<double, 3>;

template <std::size_t kCount>
void add(CdrWriter& to, const std::array<double, kCount>& numbers) {
  for (const double number : numbers) to.add(number);
}

std::vector<Place> box_lines(std::span<const Object> objects) {
  std::vector<Place> lines;
  for (const Object& object : objects) {
    const std::array<objects::Corner, 4> corners = object.box.corners();
    const auto corner = [&](std::size_t number, float height_m) -> Place {
      const auto& [x_m, y_m] = corners[number % corners.size()];
      return {static_cast<double>(x_m), static_cast<double>(y_m),
              static_cast<double>(object.ground_z_m + height_m)};
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
      lines.insert(lines.end(), {corner(i, object.bottom_m), corner(i + 1, object.bottom_m),
                                 corner(i, object.top_m), corner(i + 1, object.top_m),
                                 corner(i, object.bottom_m), corner(i, object.top_m)});
    }
  }
  return lines;
}

std::vector<Place> footprint_lines(std::span<const Object> objects) {
  std::vector<Place> lines;
  for (const Object& object : objects) {
    const std::span<const objects::Corner> corners = object.footprint.span();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (const objects::Corner& corner : {corners[i], corners[(i + 1) % corners.size()]}) {
        lines.push_back({static_cast<double>(corner.x_m), static_cast<double>(corner.y_m),
                         static_cast<double>(object.ground_z_m)});
      }
    }
  }
  return lines;
}

/// A visualization_msgs/Marker of lines between pairs of places.
void add_lines(CdrWriter& to, const publish::LabelledFrame& frame, std::string_view frame_id,
               const ObjectLines& lines) {
  constexpr std::int32_t kAdd = 0;
  add_header(to, stamp_ns_of(frame.record), frame_id);
  to.add(std::string_view(lines.name));
  to.add(std::int32_t{0});  // id
  to.add(kLineList);
  to.add(kAdd);
  add(to, std::array{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0});  // pose
  add(to, std::array{kLineWidth_m, 0.0, 0.0});             // scale
  for (const float part : lines.rgba) to.add(part);
  add_time(to, 0);  // lifetime: until it is replaced
  to.add(false);    // frame_locked
  to.add_length(lines.places_m.size());
  for (const Place& place_m : lines.places_m) add(to, place_m);
  to.add_length(0);  // colors
  to.add(std::string_view());
  add_header(to, 0, "");  // texture
  to.add(std::string_view());
  to.add_length(0);
  to.add_length(0);            // uv_coordinates
  to.add(std::string_view());  // text
  to.add(std::string_view());  // mesh_resource
  to.add(std::string_view());  // mesh_file
  to.add_length(0);
  to.add(false);  // mesh_use_embedded_materials
}

}  // namespace

BoxPose box_pose(const Object& object) noexcept {
  const objects::Box& box = object.box;
  // Both directions of the longer side are its direction; the one that looks ahead has w > 0.
  const double sign = box.along.x_m < 0 ? -1 : 1;
  const double cosine = sign * static_cast<double>(box.along.x_m);
  const double sine = sign * static_cast<double>(box.along.y_m);
  const double w = std::sqrt((1 + cosine) / 2);
  const auto bottom_m = static_cast<double>(object.bottom_m);
  const auto top_m = static_cast<double>(object.top_m);
  return {.middle_m = {static_cast<double>(box.middle.x_m), static_cast<double>(box.middle.y_m),
                       static_cast<double>(object.ground_z_m) + (bottom_m + top_m) / 2},
          .rotation_xyzw = {0, 0, sine / (2 * w), w},
          .size_m = {static_cast<double>(box.length_m), static_cast<double>(box.width_m),
                     top_m - bottom_m}};
}

BoxPose moved(const BoxPose& box, const mount::RigidTransform& T) noexcept {
  const double z = box.rotation_xyzw[2], w = box.rotation_xyzw[3];
  const double cosine = w * w - z * z, sine = 2 * w * z;
  const auto& [x_m, y_m, z_m] = box.middle_m;
  const mount::Pose pose = mount::pose_of(
      mount::chained(T, {cosine, -sine, 0, x_m, sine, cosine, 0, y_m, 0, 0, 1, z_m}));
  return {pose.translation_m, pose.rotation_xyzw, box.size_m};
}

std::array<ObjectLines, 2> object_lines(std::span<const Object> objects) {
  return {{{"boxes", {1.0F, 0.75F, 0.2F, 1.0F}, box_lines(objects)},
           {"footprints", {1.0F, 0.45F, 0.2F, 1.0F}, footprint_lines(objects)}}};
}

void write_detections(const publish::LabelledFrame& frame, std::string_view frame_id,
                      std::vector<std::byte>& message) {
  CdrWriter to(message);
  const std::int64_t stamp_ns = stamp_ns_of(frame.record);
  add_header(to, stamp_ns, frame_id);
  to.add_length(frame.objects.size());
  for (std::size_t i = 0; i < frame.objects.size(); ++i) {
    add_header(to, stamp_ns, frame_id);
    to.add_length(0);  // results
    const BoxPose box = box_pose(frame.objects[i]);
    add(to, box.middle_m);
    add(to, box.rotation_xyzw);
    add(to, box.size_m);
    to.add(std::string_view(std::to_string(i + 1)));
  }
}

void write_object_markers(const publish::LabelledFrame& frame, std::string_view frame_id,
                          std::vector<std::byte>& message) {
  CdrWriter to(message);
  const auto all_lines = object_lines(frame.objects);
  to.add_length(all_lines.size());
  for (const ObjectLines& lines : all_lines) add_lines(to, frame, frame_id, lines);
}

}  // namespace terracut::ros_messages
