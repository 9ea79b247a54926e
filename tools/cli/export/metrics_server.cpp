// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "metrics_server.hpp"

#include <memory>
#include <utility>

#include "metrics_text.hpp"
#include "tools/cli/http/http_host.hpp"

namespace terracut::cli {

Expected<HttpServer> serve_metrics(const net::Ipv4Endpoint& at, FiguresSource source,
                                   const HttpBounds& bounds) {
  const auto figures = std::make_shared<status::MonitorSnapshot>();
  const auto respond = [source = std::move(source),
                        figures](const HttpRequest& asked) -> HttpReply {
    if (is_asked_by_foreign_page(asked)) return http_refusal(403, "pages of others may not ask");
    if (asked.method != "GET") return http_refusal(405, "expected GET");
    if (asked.path == "/") {
      return HttpAnswer{.body = "terracut's figures for Prometheus are at /metrics\n"};
    }
    if (asked.path != "/metrics") return http_refusal(404, "expected /metrics");
    source(*figures);
    return HttpAnswer{.body = metrics_text(*figures),
                      .type = "text/plain; version=0.0.4; charset=utf-8"};
  };
  return HttpServer::start({.at = at, .what = "/metrics", .bounds = bounds}, respond);
}

}  // namespace terracut::cli
