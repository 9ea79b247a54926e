// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "figures_display.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

FiguresDisplay::FiguresDisplay(const WatchOptions& options) {
  open_page(options);
  if (options.metrics != "off") open_metrics(options);
}

void FiguresDisplay::show(const status::MonitorSnapshot& figures) {
  if (page_) page_->publish(figures);
  if (!metrics_) return;
  const std::scoped_lock lock(shown_mutex_);
  *shown_ = figures;
}

void FiguresDisplay::open_page(const WatchOptions& options) {
  auto page = page::StatusPagePublisher<status::MonitorSnapshot>::create(
      options.name, status::MonitorSnapshot::kLayout);
  if (page) {
    page_.emplace(*std::move(page));
  } else {
    warn("no status page: " + page.error().message);
  }
}

void FiguresDisplay::open_metrics(const WatchOptions& options) {
  const net::Ipv4Endpoint at = stream::parse_serving_endpoint(options.metrics).value();
  auto server = MetricsServer::start(net::ipv4_text(at.address), at.port,
                                     [this](status::MonitorSnapshot& figures) {
                                       const std::scoped_lock lock(shown_mutex_);
                                       figures = *shown_;
                                     });
  if (server) {
    metrics_.emplace(*std::move(server));
    say(fmt::format("figures at http://{}:{}/metrics", net::ipv4_text(at.address),
                    metrics_->port()));
  } else {
    warn("no /metrics: " + server.error().message);
  }
}

}  // namespace terracut::cli
