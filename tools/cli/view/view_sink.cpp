// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_sink.hpp"

#include <fmt/format.h>

#include <utility>

#include "frame_stream.hpp"
#include "pipeline/stream/stream_address.hpp"

namespace terracut::cli {

ViewSink::ViewSink(const publish::RunFacts& facts, ViewedCapture* capture, ComparedWith compared)
    : frames_(facts, std::move(compared)), source_{frames_, capture} {}

Expected<std::unique_ptr<ViewSink>> ViewSink::open(const std::string& endpoint,
                                                   const publish::RunFacts& facts,
                                                   ViewedCapture* capture, const HttpBounds& bounds,
                                                   ComparedWith compared) {
  const auto at = stream::parse_serving_endpoint(endpoint);
  if (!at) return tl::unexpected(at.error());
  std::unique_ptr<ViewSink> sink(new ViewSink(facts, capture, std::move(compared)));
  auto server = HttpServer::start(
      {.at = *at, .what = "the page", .bounds = bounds},
      [&source = sink->source_](const HttpRequest& asked) { return answer_view(source, asked); });
  if (!server) return tl::unexpected(server.error());
  sink->server_.emplace(*std::move(server));
  const std::uint32_t reached = at->address == 0 ? stream::kLoopbackAddress : at->address;
  sink->url_ = fmt::format("http://{}:{}/", net::ipv4_text(reached), sink->server_->port());
  return sink;
}

Status ViewSink::put(const publish::LabelledFrame& frame) {
  put_compared(frame, {});
  return {};
}

void ViewSink::put_compared(const publish::LabelledFrame& frame,
                            const FrameComparison& comparison) {
  frames_.put(frame, comparison);
  send_next();
}

Status ViewSink::put_sector(const publish::LabelledSector& sector) {
  frames_.put_sector(sector);
  send_next();
  return {};
}

void ViewSink::send_next() {
  server_->for_each_guest([](HttpGuest& guest) { static_cast<FrameStream&>(guest).send_next(); });
}

Status ViewSink::put_figures(const status::MonitorSnapshot& figures) {
  frames_.put_figures(figures);
  return {};
}

std::vector<status::NamedCount> ViewSink::losses() const {
  return {{"view_frames_skipped_by_browsers", source_.skipped},
          {"view_requests_refused", server_->figures().refused},
          {"view_browsers_stalled", server_->figures().stalled},
          {"view_sectors_skipped_by_browsers", source_.sectors_skipped}};
}

}  // namespace terracut::cli
