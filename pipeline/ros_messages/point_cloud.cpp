// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/point_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {
namespace {

void add_field(const CloudField& field, CdrWriter& to) {
  to.add(field.name);
  to.add(field.offset);
  to.add(field.datatype);
  to.add(std::uint32_t{1});  // count
}

void add_fields(bool with_height, CdrWriter& to) {
  to.add_length(std::size(kCloudFields) + (with_height ? 1 : 0));
  for (const CloudField& field : kCloudFields) add_field(field, to);
  if (with_height) add_field(kHeightField, to);
}

/// Replaces a float by the nearest multiple of kStep, a power of two; one beyond four million steps
/// stays as it is.
template <float kStep>
void round_to(std::byte* at) noexcept {
  // Added to this, a float has no bits left for less than the step.
  constexpr float kLoss = 1.5F * (1 << 23) * kStep;
  float value = 0;
  std::memcpy(&value, at, sizeof value);
  if (std::abs(value) < kLoss / 3) value = (value + kLoss) - kLoss;
  std::memcpy(at, &value, sizeof value);
}

void round_points(std::span<std::byte> points, std::size_t bytes) noexcept {
  for (std::size_t i = 0; i < points.size(); i += bytes) {
    std::byte* const point = &points[i];
    round_to<kPlaceStep_m>(point + offsetof(CloudPoint, x_m));
    round_to<kPlaceStep_m>(point + offsetof(CloudPoint, y_m));
    round_to<kPlaceStep_m>(point + offsetof(CloudPoint, z_m));
    round_to<kTimeStep_s>(point + offsetof(CloudPoint, time_s));
    if (bytes > sizeof(CloudPoint)) round_to<kPlaceStep_m>(point + kHeightField.offset);
  }
}

}  // namespace

std::size_t copy_points(CloudOf which, std::span<const points::LabelledPoint> points,
                        std::span<const float> heights_m, float time_of_first_s,
                        std::span<std::byte> to) noexcept {
  std::byte* next = to.data();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!belongs_to(which, points[i].label)) continue;
    const CloudPoint out = cloud_point(points[i], time_of_first_s);
    std::memcpy(next, &out, sizeof out);
    next += sizeof out;
    if (heights_m.empty()) continue;
    std::memcpy(next, &heights_m[i], sizeof(float));
    next += sizeof(float);
  }
  return static_cast<std::size_t>(next - to.data());
}

void write_point_cloud(const publish::LabelledFrame& frame, CloudOf which,
                       std::string_view frame_id, std::vector<std::byte>& message) {
  const std::int64_t stamp_ns = stamp_ns_of(frame.record);
  const float time_of_first_s =
      static_cast<float>(frame.record.info.first_packet_ns - stamp_ns) * 1e-9F;
  const auto points = static_cast<std::size_t>(std::ranges::count_if(
      frame.points,
      [&](const points::LabelledPoint& point) { return belongs_to(which, point.label); }));

  const bool with_height = !frame.heights_m.empty();
  const std::size_t step = point_bytes(with_height);

  CdrWriter to(message);
  add_header(to, stamp_ns, frame_id);
  to.add(std::uint32_t{1});  // height 1: the points are in order of arrival, not an image
  to.add(static_cast<std::uint32_t>(points));
  add_fields(with_height, to);
  to.add(false);  // is_bigendian
  to.add(static_cast<std::uint32_t>(step));
  to.add(static_cast<std::uint32_t>(step * points));  // row_step
  const std::span<std::byte> bytes = to.add_byte_sequence(step * points);
  (void)copy_points(which, frame.points, frame.heights_m, time_of_first_s, bytes);
  round_points(bytes, step);
  to.add(true);  // is_dense: every point is a return
}

}  // namespace terracut::ros_messages
