// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_writer.hpp"

#include <array>
#include <utility>
#include <vector>

#include "pipeline/ros_messages/header.hpp"
#include "pipeline/ros_messages/object_messages.hpp"
#include "ros_time.hpp"
#include "sequence_of.hpp"

namespace terracut::dds {
namespace {

using Point = geometry_msgs_msg_dds__Point_;
using Marker = visualization_msgs_msg_dds__Marker_;
using Detection = vision_msgs_msg_dds__Detection3D_;
using Places = std::vector<std::array<double, 3>>;

std::vector<Point> points_of(const Places& places_m) {
  std::vector<Point> points;
  for (const auto& [x, y, z] : places_m) points.push_back({x, y, z});
  return points;
}

}  // namespace

Expected<ObjectWriter> ObjectWriter::open(const Participant& participant, const std::string& boxes,
                                          const std::string& markers, const Quality& quality) {
  auto of_boxes = TopicWriter::open(participant, boxes, kDetection3DArray, quality);
  if (!of_boxes) return tl::unexpected(of_boxes.error());
  auto of_markers = TopicWriter::open(participant, markers, kMarkerArray, quality);
  if (!of_markers) return tl::unexpected(of_markers.error());
  return ObjectWriter(*std::move(of_boxes), *std::move(of_markers));
}

Status ObjectWriter::write(const publish::LabelledFrame& frame, std::string& frame_id) {
  if (boxes_.readers() > 0) {
    if (Status written = write_boxes(frame, frame_id); !written) return written;
  }
  return markers_.readers() > 0 ? write_markers(frame, frame_id) : Status();
}

Status ObjectWriter::write_boxes(const publish::LabelledFrame& frame, std::string& frame_id) {
  const std_msgs_msg_dds__Header_ header{ros_time(ros_messages::stamp_ns_of(frame.record)),
                                         frame_id.data()};
  std::vector<std::string> ids(frame.objects.size());
  std::vector<Detection> detections;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = std::to_string(i + 1);
    const auto [at_m, turned, size_m] = ros_messages::box_pose(frame.objects[i]);
    Detection detection{};
    detection.header = header;
    detection.bbox = {{{at_m[0], at_m[1], at_m[2]}, {turned[0], turned[1], turned[2], turned[3]}},
                      {size_m[0], size_m[1], size_m[2]}};
    detection.id = ids[i].data();
    detections.push_back(detection);
  }
  const vision_msgs_msg_dds__Detection3DArray_ message{
      header, sequence_of<dds_sequence_vision_msgs_msg_dds__Detection3D_>(detections)};
  return boxes_.write(&message);
}

Status ObjectWriter::write_markers(const publish::LabelledFrame& frame, std::string& frame_id) {
  std::string none;
  std::vector<Marker> markers;
  std::vector<std::vector<Point>> points;
  for (const ros_messages::ObjectLines& lines : ros_messages::object_lines(frame.objects)) {
    points.push_back(points_of(lines.places_m));
    Marker& marker = markers.emplace_back();
    marker.header = {ros_time(ros_messages::stamp_ns_of(frame.record)), frame_id.data()};
    marker.ns = const_cast<char*>(lines.name);
    marker.type = ros_messages::kLineList;
    marker.pose.orientation.w = 1;
    marker.scale.x = ros_messages::kLineWidth_m;
    marker.color = {lines.rgba[0], lines.rgba[1], lines.rgba[2], lines.rgba[3]};
    marker.texture.header.frame_id = none.data();
    for (char** text : {&marker.texture_resource, &marker.texture.format, &marker.text,
                        &marker.mesh_resource, &marker.mesh_file.filename}) {
      *text = none.data();
    }
  }
  for (std::size_t i = 0; i < markers.size(); ++i) {
    markers[i].points = sequence_of<dds_sequence_geometry_msgs_msg_dds__Point_>(points[i]);
  }
  const visualization_msgs_msg_dds__MarkerArray_ message{
      sequence_of<dds_sequence_visualization_msgs_msg_dds__Marker_>(markers)};
  return markers_.write(&message);
}

}  // namespace terracut::dds
