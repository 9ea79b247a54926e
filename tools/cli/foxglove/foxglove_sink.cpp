// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "foxglove_sink.hpp"

#include <utility>

#include "pipeline/ros_messages/diagnostic_array.hpp"
#include "pipeline/ros_messages/topics.hpp"
#include "pipeline/ros_messages/transform.hpp"

namespace terracut::cli {
namespace {

using Bytes = std::vector<std::byte>;

}  // namespace

FoxgloveSink::FoxgloveSink(FoxgloveServer server, publish::RunFacts facts)
    : server_(std::move(server)), facts_(std::move(facts)) {
  if (facts_.sensor_frame_id.empty()) return;
  auto message = std::make_shared<Bytes>();
  ros_messages::write_mount_transform(0, facts_, *message);
  server_.keep(ros_messages::kTransformsTopic, 0, std::move(message));
}

Status FoxgloveSink::put(const publish::LabelledFrame& frame) {
  const std::int64_t time_ns = ros_messages::publish_time_ns_of(frame.record);
  for (std::size_t topic = 0; topic < ros_messages::kTopics.size(); ++topic) {
    const auto write = ros_messages::kTopics[topic].write;
    if (write == nullptr || !server_.is_wanted(topic)) continue;
    auto message = std::make_shared<Bytes>();
    write(frame, facts_.frame_id, *message);
    server_.publish(topic, time_ns, std::move(message));
  }
  return {};
}

Status FoxgloveSink::put_figures(const status::MonitorSnapshot& figures) {
  const auto diagnoses = diagnoses_.of(figures);
  if (!server_.is_wanted(ros_messages::kDiagnosticsTopic)) return {};
  auto message = std::make_shared<Bytes>();
  ros_messages::write_diagnostic_array(figures.taken_ns, diagnoses, *message);
  server_.publish(ros_messages::kDiagnosticsTopic, figures.taken_ns, std::move(message));
  return {};
}

std::vector<status::NamedCount> FoxgloveSink::losses() const {
  const FoxgloveServer::Figures& figures = server_.figures();
  return {{{"foxglove_messages_skipped"}, figures.skipped},
          {{"foxglove_connections_refused"}, server_.connections().refused},
          {{"foxglove_viewers_stalled"}, server_.connections().stalled},
          {{"foxglove_requests_refused"}, figures.bad_requests}};
}

}  // namespace terracut::cli
