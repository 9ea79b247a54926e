// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_writer.hpp"

#include <algorithm>
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

std::vector<Point> points_of(const Places& places_m, const mount::RigidTransform* T) {
  std::vector<Point> points;
  for (const auto& place_m : places_m) {
    const auto& [x, y, z] = place_m;
    const auto [to_x, to_y, to_z] = T == nullptr ? place_m : mount::apply(*T, x, y, z);
    points.push_back({to_x, to_y, to_z});
  }
  return points;
}

/// Boxes of one message.
class Boxes {
 public:
  void add(const objects::Object& object, std::uint32_t id, const ObjectWriter::Seen& seen) {
    ros_messages::BoxPose box = ros_messages::box_pose(object);
    if (seen.T_frame_vehicle != nullptr) box = ros_messages::moved(box, *seen.T_frame_vehicle);
    const auto& [at_m, turned, size_m] = box;
    Detection detection{};
    detection.header = {ros_time(seen.stamp_ns), seen.frame_id.data()};
    detection.bbox = {{{at_m[0], at_m[1], at_m[2]}, {turned[0], turned[1], turned[2], turned[3]}},
                      {size_m[0], size_m[1], size_m[2]}};
    ids_.push_back(std::to_string(id));
    detections_.push_back(detection);
  }
  [[nodiscard]] Status write(TopicWriter& writer, std::int64_t stamp_ns, std::string& frame_id) {
    for (std::size_t i = 0; i < ids_.size(); ++i) detections_[i].id = ids_[i].data();
    const vision_msgs_msg_dds__Detection3DArray_ message{
        {ros_time(stamp_ns), frame_id.data()},
        sequence_of<dds_sequence_vision_msgs_msg_dds__Detection3D_>(detections_)};
    return writer.write(&message);
  }

 private:
  std::vector<std::string> ids_;
  std::vector<Detection> detections_;
};

}  // namespace

Expected<ObjectWriter> ObjectWriter::open(const Participant& participant, const Topics& topics,
                                          const Quality& quality) {
  auto boxes = TopicWriter::open(participant, topics.boxes, kDetection3DArray, quality);
  if (!boxes) return tl::unexpected(boxes.error());
  auto markers = TopicWriter::open(participant, topics.markers, kMarkerArray, quality);
  if (!markers) return tl::unexpected(markers.error());
  ObjectWriter writer(*std::move(boxes), *std::move(markers));
  if (topics.sector_boxes.empty()) return writer;
  Quality of_sectors = quality;
  of_sectors.depth = std::max(quality.depth, 32);  // a turn has no more of these messages
  auto sector_boxes =
      TopicWriter::open(participant, topics.sector_boxes, kDetection3DArray, of_sectors);
  if (!sector_boxes) return tl::unexpected(sector_boxes.error());
  writer.sector_boxes_.emplace(*std::move(sector_boxes));
  return writer;
}

Status ObjectWriter::write(std::span<const objects::Object> objects, const Seen& seen) {
  if (boxes_.readers() > 0) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < objects.size(); ++i) boxes.add(objects[i], i + 1, seen);
    Status written = boxes.write(boxes_, seen.stamp_ns, seen.frame_id);
    if (!written) return written;
  }
  return markers_.readers() > 0 ? write_markers(objects, seen) : Status();
}

Status ObjectWriter::write(const publish::LabelledFrame& frame, std::string& frame_id) {
  return write(frame.objects, {frame_id, ros_messages::stamp_ns_of(frame.record)});
}

Status ObjectWriter::write(const publish::LabelledSector& sector, std::string& frame_id) {
  if (!sector_boxes_ || sector.objects.empty() || sector_boxes_->readers() == 0) return {};
  Boxes boxes;
  for (const CompleteObject& of : sector.objects) {
    boxes.add(of.object, of.object.first_return, {frame_id, of.last_packet_ns});
  }
  return boxes.write(*sector_boxes_, sector.record.first_packet_ns, frame_id);
}

Status ObjectWriter::write_markers(std::span<const objects::Object> objects, const Seen& seen) {
  std::string none;
  std::vector<Marker> markers;
  std::vector<std::vector<Point>> points;
  for (const ros_messages::ObjectLines& lines : ros_messages::object_lines(objects)) {
    points.push_back(points_of(lines.places_m, seen.T_frame_vehicle));
    Marker& marker = markers.emplace_back();
    marker.header = {ros_time(seen.stamp_ns), seen.frame_id.data()};
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
