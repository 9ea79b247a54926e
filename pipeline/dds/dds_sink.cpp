// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dds_sink.hpp"

#include <algorithm>
#include <cstring>

#include "calib/mount/mount_pose.hpp"
#include "mount_transform.hpp"
#include "pipeline/ros_messages/header.hpp"
#include "ros_time.hpp"

namespace terracut::dds {
namespace {

using ros_messages::CloudOf;
using ros_messages::CloudPoint;

/// Returns the fields as C structures. Their texts are not const, but nobody writes to them.
std::vector<sensor_msgs_msg_dds__PointField_> cloud_fields(bool with_label, bool with_height) {
  std::vector<sensor_msgs_msg_dds__PointField_> fields;
  for (const ros_messages::CloudField& field : ros_messages::kCloudFields) {
    if (field.name == "label" && !with_label) continue;
    fields.push_back({const_cast<char*>(field.name.data()), field.offset, field.datatype, 1});
  }
  const ros_messages::CloudField& height = ros_messages::kHeightField;
  if (with_height) {
    fields.push_back({const_cast<char*>(height.name.data()), height.offset, height.datatype, 1});
  }
  return fields;
}

/// Returns the time from the stamp of the header to the frame's first packet.
float time_of_first_s_of(const publish::LabelledFrame& frame) noexcept {
  const std::int64_t stamp_ns = ros_messages::stamp_ns_of(frame.record);
  return static_cast<float>(frame.record.info.first_packet_ns - stamp_ns) * 1e-9F;
}

}  // namespace

Expected<std::unique_ptr<DdsSink>> DdsSink::open(const Config& config,
                                                 const publish::RunFacts& facts) {
  auto participant = Participant::open(config.participant);
  if (!participant) return tl::unexpected(participant.error());
  std::unique_ptr<DdsSink> sink(new DdsSink(*std::move(participant)));
  sink->config_ = config;
  sink->frame_id_ = facts.frame_id;
  sink->sensor_frame_id_ = facts.sensor_frame_id.empty() ? facts.frame_id : facts.sensor_frame_id;
  sink->T_lidar_vehicle_ = mount::inverse(mount::T_vehicle_lidar(facts.mount));
  sink->fields_ = cloud_fields(true, false);
  sink->fields_with_height_ = cloud_fields(true, true);
  sink->raw_fields_ = cloud_fields(false, false);
  Writer diagnostics;
  struct Wanted {
    Writer& writer;
    const std::string& topic;
    const MessageType& type;
    Quality quality;
  };
  // A turn of them may wait as long as a turn of whole clouds does.
  Quality of_sectors = config.quality;
  of_sectors.depth = std::max(of_sectors.depth, 128);
  for (const Wanted& wanted :
       {Wanted{sink->points_, config.points, kPointCloud2, config.quality},
        Wanted{sink->sectors_, config.sectors, kPointCloud2, of_sectors},
        Wanted{sink->ground_, config.ground, kPointCloud2, config.quality},
        Wanted{sink->obstacles_, config.obstacles, kPointCloud2, config.quality},
        Wanted{sink->road_, config.road, kPointCloud2, config.quality},
        Wanted{sink->raw_, config.raw, kPointCloud2, config.quality},
        Wanted{diagnostics, config.diagnostics, kDiagnosticArray, {}},
        Wanted{sink->tf_static_, config.tf_static, kTfMessage, kLatched}}) {
    if (wanted.topic.empty()) continue;
    auto writer = TopicWriter::open(sink->participant_, wanted.topic, wanted.type, wanted.quality);
    if (!writer) return tl::unexpected(writer.error());
    wanted.writer.emplace(*std::move(writer));
  }
  if (diagnostics) sink->diagnostics_.emplace(*std::move(diagnostics));
  if (!config.objects.empty()) {
    auto objects = ObjectWriter::open(
        sink->participant_, {config.objects, config.object_markers, config.sector_objects},
        config.quality);
    if (!objects) return tl::unexpected(objects.error());
    sink->objects_.emplace(*std::move(objects));
  }
  if (!config.free_way.empty()) {
    auto free_way = FreeWayWriter::open(sink->participant_, config.free_way, config.quality);
    if (!free_way) return tl::unexpected(free_way.error());
    sink->free_way_.emplace(*std::move(free_way));
  }
  if (sink->tf_static_ && !facts.sensor_frame_id.empty()) {
    const Status told =
        write_mount(*sink->tf_static_, facts.mount, facts.sensor_frame_id, facts.frame_id);
    if (!told) return tl::unexpected(told.error());
  }
  return sink;
}

Status DdsSink::put(const publish::LabelledFrame& frame) {
  await_readers();
  const auto put_cloud = [&](Writer& writer, CloudOf which) {
    put_points(writer, frame.points, frame.heights_m, ros_messages::stamp_ns_of(frame.record),
               time_of_first_s_of(frame), which);
  };
  // The free way, objects and obstacles are published first, because planners stop for them.
  if (free_way_ && !free_way_->write(frame, frame_id_)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
  }
  if (objects_ && !objects_->write(frame, frame_id_)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
  }
  put_cloud(obstacles_, CloudOf::kObstacles);
  put_cloud(ground_, CloudOf::kGround);
  put_cloud(road_, CloudOf::kRoad);
  put_cloud(points_, CloudOf::kAll);
  put_raw(frame);
  return {};
}

/// Waits for slow readers: a writer's history that overflows would lose frames without a sign.
void DdsSink::await_readers() {
  const auto all_have_it = [&](Writer& writer) {
    return !writer || writer->is_acknowledged(config_.patience_ns);
  };
  const bool all = all_have_it(points_) && all_have_it(obstacles_) && all_have_it(ground_) &&
                   all_have_it(road_) && all_have_it(raw_);
  behind_ = all ? 0 : behind_ + 1;
  if (behind_ > config_.quality.depth) unacknowledged_.fetch_add(1, std::memory_order_relaxed);
}

Status DdsSink::put_sector(const publish::LabelledSector& sector) {
  put_points(sectors_, sector.points, sector.heights_m, sector.record.first_packet_ns, 0,
             CloudOf::kAll);
  if (objects_ && !objects_->write(sector, frame_id_)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
  }
  return {};
}

void DdsSink::put_points(Writer& writer, std::span<const points::LabelledPoint> points,
                         std::span<const float> heights_m, std::int64_t stamp_ns,
                         float time_of_first_s, CloudOf which) {
  if (!writer || writer->readers() == 0) return;
  const std::size_t step = ros_messages::point_bytes(!heights_m.empty());
  bytes_.resize(points.size() * step);
  bytes_.resize(ros_messages::copy_points(which, points, heights_m, time_of_first_s,
                                          std::as_writable_bytes(std::span(bytes_))));
  write(*writer, stamp_ns, frame_id_, heights_m.empty() ? fields_ : fields_with_height_, step);
}

void DdsSink::put_raw(const publish::LabelledFrame& frame) {
  if (!raw_ || raw_->readers() == 0) return;
  bytes_.resize(frame.points.size() * sizeof(CloudPoint));
  std::uint8_t* to = bytes_.data();
  const float time_of_first_s = time_of_first_s_of(frame);
  for (const points::LabelledPoint& point : frame.points) {
    CloudPoint raw = ros_messages::cloud_point(point, time_of_first_s);
    const auto at_m = mount::apply(T_lidar_vehicle_, point.x_m, point.y_m, point.z_m);
    raw.x_m = static_cast<float>(at_m[0]);
    raw.y_m = static_cast<float>(at_m[1]);
    raw.z_m = static_cast<float>(at_m[2]);
    raw.label = 0;
    std::memcpy(to, &raw, sizeof(raw));
    to += sizeof(raw);
  }
  write(*raw_, ros_messages::stamp_ns_of(frame.record), sensor_frame_id_, raw_fields_,
        sizeof(CloudPoint));
}

void DdsSink::write(TopicWriter& writer, std::int64_t stamp_ns, std::string& frame_id,
                    std::vector<sensor_msgs_msg_dds__PointField_>& fields, std::size_t step) {
  const auto bytes = static_cast<std::uint32_t>(bytes_.size());
  sensor_msgs_msg_dds__PointCloud2_ cloud{};
  cloud.header = {ros_time(stamp_ns), frame_id.data()};
  cloud.height = 1;
  cloud.width = bytes / static_cast<std::uint32_t>(step);
  cloud.fields._buffer = fields.data();
  cloud.fields._length = cloud.fields._maximum = static_cast<std::uint32_t>(fields.size());
  cloud.point_step = static_cast<std::uint32_t>(step);
  cloud.row_step = bytes;
  cloud.data._buffer = bytes_.data();
  cloud.data._length = cloud.data._maximum = bytes;
  cloud.is_dense = true;
  if (!writer.write(&cloud)) refused_.fetch_add(1, std::memory_order_relaxed);
}

Status DdsSink::put_figures(const status::MonitorSnapshot& figures) {
  if (diagnostics_ && !diagnostics_->write(figures)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
  }
  return {};
}

Status DdsSink::finish() {
  // The last messages may still be on their way to reliable readers.
  constexpr std::int64_t kPatience_ns = 1'000'000'000;
  for (Writer* writer : {&points_, &sectors_, &obstacles_, &ground_, &road_, &raw_}) {
    if (*writer) (void)(*writer)->is_acknowledged(kPatience_ns);
  }
  return {};
}

std::vector<status::NamedCount> DdsSink::losses() const {
  return {{"dds_frames_unacknowledged", unacknowledged_.load()},
          {"dds_messages_refused", refused_.load()}};
}

}  // namespace terracut::dds
