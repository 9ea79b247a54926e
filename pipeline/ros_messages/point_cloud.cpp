// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/point_cloud.hpp"

#include <algorithm>
#include <cstring>

#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {
namespace {

void add_fields(CdrWriter& to) {
  to.add_length(std::size(kCloudFields));
  for (const CloudField& field : kCloudFields) {
    to.add(field.name);
    to.add(field.offset);
    to.add(field.datatype);
    to.add(std::uint32_t{1});  // count
  }
}

}  // namespace

void write_point_cloud(const publish::LabelledFrame& frame, CloudOf which,
                       std::string_view frame_id, std::vector<std::byte>& message) {
  const std::int64_t stamp_ns = stamp_ns_of(frame.record);
  const float time_of_first_s =
      static_cast<float>(frame.record.info.first_packet_ns - stamp_ns) * 1e-9F;
  const auto points = static_cast<std::size_t>(std::ranges::count_if(
      frame.points,
      [&](const points::LabelledPoint& point) { return belongs_to(which, point.label); }));

  CdrWriter to(message);
  add_header(to, stamp_ns, frame_id);
  to.add(std::uint32_t{1});  // height 1: the points are in order of arrival, not an image
  to.add(static_cast<std::uint32_t>(points));
  add_fields(to);
  to.add(false);  // is_bigendian
  to.add(static_cast<std::uint32_t>(sizeof(CloudPoint)));
  to.add(static_cast<std::uint32_t>(sizeof(CloudPoint) * points));  // row_step
  std::byte* next = to.add_byte_sequence(sizeof(CloudPoint) * points).data();
  for (const points::LabelledPoint& point : frame.points) {
    if (!belongs_to(which, point.label)) continue;
    const CloudPoint out = cloud_point(point, time_of_first_s);
    std::memcpy(next, &out, sizeof out);
    next += sizeof out;
  }
  to.add(true);  // is_dense: every point is a return
}

}  // namespace terracut::ros_messages
