// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/output/dds_output.hpp"

#include <fmt/format.h>

#include <utility>

#include "pipeline/dds/dds_sink.hpp"
#include "pipeline/dds/ros_topic.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/output/dds_participant.hpp"

namespace terracut::cli {

DdsTopics dds_topics_of(const DdsOptions& options) {
  DdsTopics topics{
      .points = "~/points", .ground = "~/ground", .obstacles = "~/obstacles", .road = "~/road"};
  switch (options.preset) {
    case DdsPreset::kRos:
      break;
    case DdsPreset::kAutoware:  // Autoware's planner stops for obstacles
      topics = {.obstacles = "/perception/obstacle_segmentation/pointcloud"};
      break;
    case DdsPreset::kNav2:  // the defaults of Nav2's GroundConsistencyLayer
      topics = {.ground = "/ground_points", .obstacles = "/nonground_points"};
      break;
  }
  topics.free_way = options.free_way == "off" ? "" : options.free_way;
  topics.objects = options.objects == "off" ? "" : options.objects;
  if (options.sectors != "off") topics.sectors = options.sectors;
  if (!options.raw.empty() && options.raw != "off") topics = {.raw = options.raw};
  const auto state = [](const std::string& stated, std::string& topic) {
    if (!stated.empty()) topic = stated == "off" ? "" : stated;
  };
  state(options.points, topics.points);
  state(options.ground, topics.ground);
  state(options.obstacles, topics.obstacles);
  state(options.road, topics.road);
  state(options.diagnostics, topics.diagnostics);
  return topics;
}

dds::Participant::Config participant_config_of(const DdsOptions& options) {
  return {.domain = options.domain,
          .interface = options.interface,
          .fragment_bytes = options.fragment_bytes,
          .receive_buffer_bytes = options.receive_buffer_kib << 10};
}

std::string dds_topic_of(const std::string& name, const DdsOptions& options) {
  return name.empty() ? "" : dds::dds_topic(name, options.node).value_or("");
}

std::string topic_list(const DdsOptions& options) {
  const DdsTopics topics = dds_topics_of(options);
  std::string list;
  for (const std::string& topic :
       {topics.points, topics.sectors, topics.ground, topics.obstacles, topics.raw}) {
    const std::string name = dds_topic_of(topic, options);
    if (!name.empty()) list += (list.empty() ? "" : ", ") + name.substr(2);  // without "rt"
  }
  return list;
}

Status check_dds() {
  return {};
}

Expected<std::unique_ptr<publish::FrameSink>> open_dds_sink(const DdsOptions& options,
                                                            const publish::RunFacts& facts) {
  constexpr std::int64_t kPatience_ns = 10'000'000'000;
  const DdsTopics topics = dds_topics_of(options);
  const auto topic = [&](const std::string& name) { return dds_topic_of(name, options); };
  auto sink = dds::DdsSink::open({.participant = participant_config_of(options),
                                  .quality = {.reliable = options.reliable, .depth = options.depth},
                                  .points = topic(topics.points),
                                  .sectors = topic(topics.sectors),
                                  .ground = topic(topics.ground),
                                  .obstacles = topic(topics.obstacles),
                                  .road = facts.has_road ? topic(topics.road) : "",
                                  .raw = topic(topics.raw),
                                  .objects = facts.found.objects ? topic(topics.objects) : "",
                                  .object_markers = topic(topics.objects + "/markers"),
                                  .sector_objects = topics.sectors.empty() || topics.objects.empty()
                                                        ? ""
                                                        : topic(topics.sectors + "/objects"),
                                  .free_way = facts.found.free_way ? topic(topics.free_way) : "",
                                  .diagnostics = topic(topics.diagnostics),
                                  .tf_static = topic("/tf_static"),
                                  // A recording waits for readers, because it must not lose a
                                  // frame; a live run waits for nobody.
                                  .patience_ns = facts.deadline_ns == 0 ? kPatience_ns : 0},
                                 facts);
  if (!sink) return tl::unexpected(sink.error());
  say(fmt::format("ROS 2 messages on DDS domain {}: {}", (*sink)->domain(), topic_list(options)));
  return std::unique_ptr<publish::FrameSink>(*std::move(sink));
}

}  // namespace terracut::cli
