// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/output/output_sinks.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/mcap/mcap_sink.hpp"
#include "pipeline/publish/retried_sink.hpp"
#include "pipeline/ros_messages/topics.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/door_news.hpp"
#include "tools/cli/foxglove/foxglove_sink.hpp"
#include "tools/cli/output/dds_output.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace terracut::cli {
namespace {

using Sink = std::unique_ptr<publish::FrameSink>;

mcap::McapSink::Config mcap_config_of(const OutputOptions& options, bool unattended) {
  return {.path = options.mcap.path,
          .split_bytes = static_cast<std::uint64_t>(options.mcap.split_mb * 1e6),
          .split_ns = static_cast<std::int64_t>(options.mcap.split_s * 1e9),
          .points_alone = options.mcap.clouds == McapClouds::kPoints,
          .metadata = key_values_of(options.metadata),
          .unattended = unattended};
}

Expected<Sink> open_mcap(const OutputOptions& options, const publish::RunFacts& facts,
                         bool unattended) {
  std::error_code error;
  if (!unattended && std::filesystem::is_regular_file(options.mcap.path, error)) {
    say("will be replaced: " + options.mcap.path.string());
  }
  auto sink = mcap::McapSink::open(mcap_config_of(options, unattended), facts);
  if (!sink) return tl::unexpected(sink.error());
  if (unattended) say("recording to " + (*sink)->path().string());
  return *std::move(sink);
}

Expected<Sink> open_view(const std::string& endpoint, const publish::RunFacts& facts) {
  auto view = ViewSink::open(endpoint, facts, nullptr);
  if (!view) return tl::unexpected(view.error());
  say("look at the frames in a browser: " + (*view)->url());
  return *std::move(view);
}

/// Sets the names of coordinate frames from the options.
void name_frames(const OutputOptions& options, publish::RunFacts& facts) {
  facts.frame_id = options.frame_id;
  facts.sensor_frame_id = options.sensor_frame_id == "off" ? "" : options.sensor_frame_id;
}

bool wants_view(const OutputOptions& options) {
  return !options.view.empty() && options.view != "off";
}
bool dds_wants_sectors(const OutputOptions& options) {
  const std::string& sectors = options.dds.sectors;
  return options.dds.publishes && !sectors.empty() && sectors != "off";
}

/// A requested output, and how to open it.
struct Output {
  std::string name;
  std::function<Expected<Sink>()> open;
  std::size_t queue_frames = 2;
  bool wants_sectors = false;
  bool is_to_be_whole = false;
};

std::vector<Output> outputs_of(const OutputOptions& options, publish::RunFacts facts,
                               bool unattended) {
  name_frames(options, facts);
  std::vector<Output> outputs;
  if (!options.mcap.path.empty()) {
    outputs.push_back({.name = "mcap",
                       .open = [=] { return open_mcap(options, facts, unattended); },
                       .queue_frames = mcap::McapSink::kQueueFrames,
                       .is_to_be_whole = true});
  }
  if (!options.foxglove.empty()) {
    outputs.push_back(
        {.name = "foxglove", .open = [=] { return open_foxglove(options, facts, nullptr); }});
  }
  if (options.dds.publishes) {
    outputs.push_back({.name = "dds",
                       .open = [=] { return open_dds_sink(options.dds, facts); },
                       .wants_sectors = dds_wants_sectors(options),
                       .is_to_be_whole = true});
  }
  if (wants_view(options)) {
    outputs.push_back({.name = "view",
                       .open = [=] { return open_view(options.view, facts); },
                       .wants_sectors = facts.gives_sectors});
  }
  return outputs;
}

}  // namespace

Expected<std::unique_ptr<publish::FrameSink>> open_foxglove(const OutputOptions& options,
                                                            publish::RunFacts facts,
                                                            ViewedCapture* capture) {
  name_frames(options, facts);
  std::vector<bool> topics;
  for (const ros_messages::Topic& topic : ros_messages::kTopics) {
    topics.push_back(ros_messages::is_made(topic, facts));
  }
  const net::Ipv4Endpoint at = stream::parse_serving_endpoint(options.foxglove).value();
  auto server = FoxgloveServer::start({.at = at,
                                       .name = "terracut: " + facts.sensor,
                                       .topics = std::move(topics),
                                       .origins = options.foxglove_origins,
                                       .capture = capture});
  if (!server) return tl::unexpected(server.error());
  say(fmt::format("Foxglove and Lichtblick connect to ws://{}:{}", net::ipv4_text(at.address),
                  server->port()));
  return std::make_unique<FoxgloveSink>(*std::move(server), std::move(facts));
}

bool wants_sinks(const OutputOptions& options) {
  return !options.mcap.path.empty() || !options.foxglove.empty() || options.dds.publishes ||
         wants_view(options);
}

bool wants_sector_objects(const OutputOptions& options) {
  return dds_wants_sectors(options) && options.dds.objects != "off";
}

bool wants_sectors(const OutputOptions& options) {
  return dds_wants_sectors(options) || wants_view(options);
}

Expected<publish::Publisher::Sinks> open_sinks(const OutputOptions& options,
                                               publish::RunFacts facts) {
  publish::Publisher::Sinks sinks;
  for (const Output& output : outputs_of(options, std::move(facts), false)) {
    auto sink = output.open();
    if (!sink) return tl::unexpected(sink.error());
    sinks.push_back(*std::move(sink));
  }
  return sinks;
}

publish::Publisher::Sinks retried_sinks(const OutputOptions& options, publish::RunFacts facts) {
  publish::Publisher::Sinks sinks;
  for (Output& output : outputs_of(options, std::move(facts), true)) {
    const auto tell = [name = output.name](const Status& now) {
      tell_of_door("frames for " + name, now);
    };
    sinks.push_back(std::make_unique<publish::RetriedSink>(
        publish::RetriedSink::Config{.name = output.name,
                                     .queue_frames = output.queue_frames,
                                     .wants_sectors = output.wants_sectors,
                                     .inner = {.open = std::move(output.open), .on_news = tell},
                                     .is_to_be_whole = output.is_to_be_whole}));
  }
  return sinks;
}

Status check_sinks(const OutputOptions& options) {
  if (!options.mcap.path.empty()) {
    if (Status mcap = mcap::McapSink::check(mcap_config_of(options, true)); !mcap) return mcap;
  }
  return options.dds.publishes ? check_dds() : Status{};
}

void warn_of_failure(std::string_view sink, const Error& error) {
  warn(fmt::format("no more frames for {}: {}", sink, error.message));
}

}  // namespace terracut::cli
