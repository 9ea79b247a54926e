// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "figures_display.hpp"

#include <fmt/format.h>

#include <array>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/door_news.hpp"

namespace terracut::cli {

FiguresDisplay::FiguresDisplay(const WatchOptions& options)
    : page_({.open =
                 [name = options.name] {
                   return Page::create(name, status::MonitorSnapshot::kLayout);
                 },
             .on_news = [](const Status& now) { tell_of_door("the status page", now); }}) {
  if (options.metrics != "off") metrics_.emplace(metrics_at(options.metrics));
}

void FiguresDisplay::show(const status::MonitorSnapshot& figures) {
  if (Page* const page = page_.get()) page->publish(figures);
  if (!metrics_ || metrics_->get() == nullptr) return;
  const std::scoped_lock lock(shown_mutex_);
  *shown_ = figures;
}

void FiguresDisplay::add_losses(status::MonitorSnapshot& figures) {
  const HttpServer* const server = metrics_ ? metrics_->opened() : nullptr;
  if (server == nullptr) return;
  const std::uint64_t refused = server->figures().refused;
  status::show_losses(std::array{status::NamedCount{"metrics_requests_refused", refused}}, figures);
}

publish::Reopened<HttpServer>::Config FiguresDisplay::metrics_at(const std::string& endpoint) {
  const net::Ipv4Endpoint at = stream::parse_serving_endpoint(endpoint).value();
  const auto read = [this](status::MonitorSnapshot& figures) {
    const std::scoped_lock lock(shown_mutex_);
    figures = *shown_;
  };
  const auto open = [at, read]() -> Expected<HttpServer> {
    auto server = serve_metrics(at, read);
    if (server) {
      say(fmt::format("figures at http://{}:{}/metrics", net::ipv4_text(at.address),
                      server->port()));
    }
    return server;
  };
  return {.open = open, .on_news = [](const Status& now) { tell_of_door("/metrics", now); }};
}

}  // namespace terracut::cli
