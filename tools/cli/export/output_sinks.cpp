// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "output_sinks.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/mcap/mcap_sink.hpp"
#include "pipeline/ros_messages/topics.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/dds_output.hpp"
#include "tools/cli/foxglove/foxglove_sink.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace terracut::cli {
namespace {

Expected<std::unique_ptr<publish::FrameSink>> open_mcap(const OutputOptions& options,
                                                        const publish::Stream& stream) {
  auto sink =
      mcap::McapSink::open({.path = options.mcap.path,
                            .split_bytes = static_cast<std::uint64_t>(options.mcap.split_mb * 1e6),
                            .split_ns = static_cast<std::int64_t>(options.mcap.split_s * 1e9),
                            .points_alone = options.mcap.clouds == McapClouds::kPoints,
                            .metadata = key_values_of(options.metadata)},
                           stream);
  if (!sink) return tl::unexpected(sink.error());
  return *std::move(sink);
}

/// The names of coordinate frames that the options say.
void name_frames(const OutputOptions& options, publish::Stream& stream) {
  stream.frame_id = options.frame_id;
  stream.sensor_frame_id = options.sensor_frame_id == "off" ? "" : options.sensor_frame_id;
}

bool wants_view(const OutputOptions& options) {
  return !options.view.empty() && options.view != "off";
}

}  // namespace

Expected<std::unique_ptr<publish::FrameSink>> open_foxglove(const OutputOptions& options,
                                                            publish::Stream stream,
                                                            ViewedCapture* capture) {
  name_frames(options, stream);
  std::vector<bool> topics(ros_messages::kTopics.size(), true);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    // Without the road's surface all ground is road.
    if (ros_messages::kTopics[i].cloud == ros_messages::CloudOf::kRoad) {
      topics[i] = stream.has_road;
    }
  }
  topics[ros_messages::kTransformsTopic] = !stream.sensor_frame_id.empty();
  const net::Ipv4Endpoint at = stream::parse_serving_endpoint(options.foxglove).value();
  auto server = FoxgloveServer::start({.at = at,
                                       .name = "terracut: " + stream.sensor,
                                       .topics = std::move(topics),
                                       .origins = options.foxglove_origins,
                                       .capture = capture});
  if (!server) return tl::unexpected(server.error());
  say(fmt::format("Foxglove and Lichtblick connect to ws://{}:{}", net::ipv4_text(at.address),
                  server->port()));
  return std::make_unique<FoxgloveSink>(*std::move(server), std::move(stream));
}

bool wants_sinks(const OutputOptions& options) {
  return !options.mcap.path.empty() || !options.foxglove.empty() || options.dds.publishes ||
         wants_view(options);
}

Expected<publish::Publisher::Sinks> open_sinks(const OutputOptions& options,
                                               publish::Stream stream) {
  name_frames(options, stream);
  publish::Publisher::Sinks sinks;
  if (!options.mcap.path.empty()) {
    auto sink = open_mcap(options, stream);
    if (!sink) return tl::unexpected(sink.error());
    sinks.push_back(*std::move(sink));
  }
  if (!options.foxglove.empty()) {
    auto sink = open_foxglove(options, stream, nullptr);
    if (!sink) return tl::unexpected(sink.error());
    sinks.push_back(*std::move(sink));
  }
  if (options.dds.publishes) {
    auto sink = open_dds_sink(options.dds, stream);
    if (!sink) return tl::unexpected(sink.error());
    sinks.push_back(*std::move(sink));
  }
  if (wants_view(options)) {
    auto view = ViewSink::open(options.view, stream, nullptr);
    if (!view) return tl::unexpected(view.error());
    say("look at the frames in a browser: " + (*view)->url());
    sinks.push_back(*std::move(view));
  }
  return sinks;
}

void warn_of_failure(std::string_view sink, const Error& error) {
  warn(fmt::format("no more frames for {}: {}", sink, error.message));
}

}  // namespace terracut::cli
