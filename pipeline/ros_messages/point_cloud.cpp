// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/point_cloud.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "firmware_io/frame/label.hpp"
#include "pipeline/output/label_sink.hpp"
#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {
namespace {

constexpr auto kRoadClass =
    static_cast<std::uint8_t>(output::semantic_kitti_class(frame::Label::kGround));
constexpr auto kOtherGroundClass =
    static_cast<std::uint8_t>(output::semantic_kitti_class(frame::Label::kOtherGround));
constexpr auto kObstacleClass =
    static_cast<std::uint8_t>(output::semantic_kitti_class(frame::Label::kObstacle));

void add_fields(CdrWriter& to) {
  to.add_length(std::size(kCloudFields));
  for (const CloudField& field : kCloudFields) {
    to.add(field.name);
    to.add(field.offset);
    to.add(field.datatype);
    to.add(std::uint32_t{1});  // count
  }
}

/// Of each class whether it belongs, so that the points are passed over without a branch a class.
std::array<bool, 256> table_of(CloudOf which) noexcept {
  std::array<bool, 256> belongs{};
  for (std::size_t label = 0; label < belongs.size(); ++label) {
    belongs[label] = belongs_to(which, static_cast<std::uint8_t>(label));
  }
  return belongs;
}

}  // namespace

bool belongs_to(CloudOf which, std::uint8_t label) noexcept {
  switch (which) {
    case CloudOf::kAll:
      return true;
    case CloudOf::kGround:
      return label == kRoadClass || label == kOtherGroundClass;
    case CloudOf::kObstacles:
      return label == kObstacleClass;
    case CloudOf::kRoad:
      return label == kRoadClass;
  }
  return false;
}

void write_point_cloud(const publish::LabelledFrame& frame, CloudOf which,
                       std::string_view frame_id, std::vector<std::byte>& message) {
  const std::int64_t stamp_ns = stamp_ns_of(frame.record);
  const float time_of_first_s =
      static_cast<float>(frame.record.info.first_packet_ns - stamp_ns) * 1e-9F;
  const std::array<bool, 256> belongs = table_of(which);
  const auto points = static_cast<std::size_t>(std::ranges::count_if(
      frame.points, [&](const stream::LabelledPoint& point) { return belongs[point.label]; }));

  CdrWriter to(message);
  add_header(to, stamp_ns, frame_id);
  to.add(std::uint32_t{1});  // height: in order of arrival, no image
  to.add(static_cast<std::uint32_t>(points));
  add_fields(to);
  to.add(false);  // is_bigendian
  to.add(static_cast<std::uint32_t>(sizeof(CloudPoint)));
  to.add(static_cast<std::uint32_t>(sizeof(CloudPoint) * points));  // row_step
  std::byte* next = to.add_byte_sequence(sizeof(CloudPoint) * points).data();
  for (const stream::LabelledPoint& point : frame.points) {
    if (!belongs[point.label]) continue;
    const CloudPoint out = cloud_point(point, time_of_first_s);
    std::memcpy(next, &out, sizeof out);
    next += sizeof out;
  }
  to.add(true);  // is_dense: every point is a return
}

}  // namespace terracut::ros_messages
