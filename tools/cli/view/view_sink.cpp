// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_sink.hpp"

#include <utility>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/stream/stream_address.hpp"

namespace terracut::cli {

ViewSink::ViewSink(const publish::Stream& stream, ViewedCapture* capture)
    : frames_(stream), source_{frames_, capture} {}

Expected<std::unique_ptr<ViewSink>> ViewSink::open(const std::string& endpoint,
                                                   const publish::Stream& stream,
                                                   ViewedCapture* capture) {
  const auto at = stream::parse_serving_endpoint(endpoint);
  if (!at) return tl::unexpected(at.error());
  std::unique_ptr<ViewSink> sink(new ViewSink(stream, capture));
  auto server = ViewServer::start(net::ipv4_text(at->address), at->port, sink->source_);
  if (!server) return tl::unexpected(server.error());
  sink->server_ = std::make_unique<ViewServer>(*std::move(server));
  return sink;
}

Status ViewSink::put(const publish::LabelledFrame& frame) {
  frames_.put(frame);
  return {};
}

Status ViewSink::put_figures(const status::MonitorSnapshot& figures) {
  frames_.put_figures(figures);
  return {};
}

std::vector<status::NamedCount> ViewSink::losses() const {
  return {{"view_frames_skipped_by_browsers", source_.skipped}};
}

}  // namespace terracut::cli
