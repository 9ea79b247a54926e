// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "node_topics.hpp"

#include <string>
#include <utility>

#include "pipeline/dds/mount_transform.hpp"
#include "pipeline/ros_messages/header.hpp"
#include "tools/cli/output/dds_output.hpp"
#include "tools/cli/output/dds_participant.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

using frame::Label;

void keep_first_error(Status& first, Status next) {
  if (first && !next) first = std::move(next);
}

}  // namespace

Expected<std::optional<dds::TopicWriter>> open_writer(const dds::Participant& participant,
                                                      const std::string& name,
                                                      const dds::MessageType& type,
                                                      const DdsOptions& options) {
  if (name.empty()) return std::optional<dds::TopicWriter>{};
  auto writer = dds::TopicWriter::open(participant, dds_topic_of(name, options), type,
                                       {.reliable = options.reliable, .depth = options.depth});
  if (!writer) return tl::unexpected(writer.error());
  return std::optional<dds::TopicWriter>(*std::move(writer));
}

Expected<NodeAnswers> NodeAnswers::open(const dds::Participant& participant,
                                        const Options& options) {
  DdsTopics topics = dds_topics_of(options.output.dds);
  if (!method_config_of(options.method).segmenter.road.enabled) topics.road.clear();
  struct Wanted {
    std::optional<dds::TopicWriter> NodeAnswers::* writer;
    std::string topic;
    const dds::MessageType& type;
  };
  NodeAnswers answers;
  for (const Wanted& wanted : {
           Wanted{&NodeAnswers::points_, topics.points, dds::kPointCloud2},
           Wanted{&NodeAnswers::ground_, topics.ground, dds::kPointCloud2},
           Wanted{&NodeAnswers::obstacles_, topics.obstacles, dds::kPointCloud2},
           Wanted{&NodeAnswers::road_, topics.road, dds::kPointCloud2},
           Wanted{&NodeAnswers::processing_time_, "~/debug/processing_time_ms",
                  dds::kFloat64Stamped},
           Wanted{&NodeAnswers::cyclic_time_, "~/debug/cyclic_time_ms", dds::kFloat64Stamped},
       }) {
    auto writer = open_writer(participant, wanted.topic, wanted.type, options.output.dds);
    if (!writer) return tl::unexpected(writer.error());
    answers.*wanted.writer = *std::move(writer);
  }
  if (Status opened = answers.open_scene(participant, options); !opened) {
    return tl::unexpected(opened.error());
  }
  return answers;
}

Status NodeAnswers::open_scene(const dds::Participant& participant, const Options& options) {
  const DdsOptions& dds = options.output.dds;
  const DdsTopics topics = dds_topics_of(dds);
  const dds::Quality quality{.reliable = dds.reliable, .depth = dds.depth};
  if (options.method.scene.objects && !topics.objects.empty()) {
    auto objects =
        dds::ObjectWriter::open(participant,
                                {.boxes = dds_topic_of(topics.objects, dds),
                                 .markers = dds_topic_of(topics.objects + "/markers", dds),
                                 .sector_boxes = ""},
                                quality);
    if (!objects) return tl::unexpected(objects.error());
    objects_.emplace(*std::move(objects));
  }
  if (!options.method.scene.free_way || topics.free_way.empty()) return {};
  auto free_way =
      dds::FreeWayWriter::open(participant, dds_topic_of(topics.free_way, dds), quality);
  if (!free_way) return tl::unexpected(free_way.error());
  auto tf_static = dds::TopicWriter::open(participant, dds_topic_of("/tf_static", dds),
                                          dds::kTfMessage, dds::kLatched);
  if (!tf_static) return tl::unexpected(tf_static.error());
  free_way_.emplace(*std::move(free_way));
  tf_static_.emplace(*std::move(tf_static));
  vehicle_frame_ = options.output.frame_id;
  return {};
}

Status NodeAnswers::write(NodeScene& scene) {
  Status first;
  if (free_way_) {
    if (!is_vehicle_frame_told_) {
      Status told = dds::write_mount(*tf_static_, scene.mount, scene.cloud_frame, vehicle_frame_);
      is_vehicle_frame_told_ = told.has_value();
      keep_first_error(first, std::move(told));
    }
    keep_first_error(first, free_way_->write(scene.frame, vehicle_frame_));
  }
  if (objects_) {
    const std::int64_t stamp_ns = ros_messages::stamp_ns_of(scene.frame.record);
    keep_first_error(first, objects_->write(scene.frame.objects, {scene.answer_frame, stamp_ns,
                                                                  &scene.T_answer_vehicle}));
  }
  return first;
}

Status NodeAnswers::write(const dds::RosCloud& cloud, std::span<const Label> labels,
                          std::span<const float> heights_m, const Times& times) {
  Status first;
  const auto put = [&](dds::TopicWriter& writer, const void* message) {
    keep_first_error(first, writer.write(message));
  };
  // Obstacles are published first, because planners stop for them.
  if (is_read(obstacles_)) {
    put(*obstacles_,
        &derived_.select(cloud, labels, [](Label l) { return l == Label::kObstacle; }));
  }
  if (is_read(ground_)) {
    put(*ground_, &derived_.select(cloud, labels, [](Label l) { return is_ground(l); }));
  }
  if (is_read(road_)) {
    put(*road_, &derived_.select(cloud, labels, [](Label l) { return l == Label::kGround; }));
  }
  if (is_read(points_)) put(*points_, &derived_.with_labels(cloud, labels, heights_m));
  const auto put_time = [&](std::optional<dds::TopicWriter>& writer, double time_ms) {
    const autoware_internal_debug_msgs_msg_dds__Float64Stamped_ message{cloud.header.stamp,
                                                                        time_ms};
    if (is_read(writer)) put(*writer, &message);
  };
  put_time(processing_time_, times.processing_ms);
  put_time(cyclic_time_, times.cyclic_ms);
  return first;
}

}  // namespace terracut::cli
