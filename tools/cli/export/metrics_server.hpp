// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>

#include "pipeline/status/monitor_snapshot.hpp"
#include "rt/error.hpp"
#include "tools/cli/http/http_server.hpp"

namespace terracut::cli {

/// A function that copies the newest figures. Called on the server's thread, never after the
/// server's end.
using FiguresSource = std::function<void(status::MonitorSnapshot&)>;

/// Answers GET /metrics with the figures for Prometheus (metrics_text.hpp), within HttpBounds.
/// Listen on loopback unless the network is trusted. Requests from foreign web pages get 403. Fails
/// with the errors of HttpServer::start().
[[nodiscard]] Expected<HttpServer> serve_metrics(const net::Ipv4Endpoint& at, FiguresSource source,
                                                 const HttpBounds& bounds = {});

}  // namespace terracut::cli
