// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "pipeline/status/monitor_snapshot.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Returns GET /metrics with the figures for Prometheus (metrics_text.hpp), over HTTP, from one
/// thread of its own and of the caller's scheduling class: start it from a normal thread.
///
/// One connection at a time, one request a connection, little memory: a slow or hostile client can
/// keep others from the figures, but nothing else. There is neither encryption nor a password, so
/// listen on loopback unless the network is trusted. Requests whose Host header names another
/// machine (http_host.hpp) get 403: a web page cannot read the figures through the browser that
/// shows it.
class MetricsServer {
 public:
  /// Copies the newest figures. Called on the server's thread, never after the MetricsServer is
  /// gone.
  using Source = std::function<void(status::MonitorSnapshot&)>;

  /// Listens on `address` (numeric) : `port`, 0 for any free one. Errors: kInvalidArgument with the
  /// system's reason, such as a port in use.
  [[nodiscard]] static Expected<MetricsServer> start(const std::string& address, std::uint16_t port,
                                                     Source source);

  MetricsServer(MetricsServer&&) noexcept;
  /// Stops listening. Waits for a request being answered, but no longer than two seconds.
  ~MetricsServer();

  [[nodiscard]] std::uint16_t port() const noexcept;

 private:
  struct State;
  explicit MetricsServer(std::shared_ptr<State> state);

  std::shared_ptr<State> state_;
};

}  // namespace terracut::cli
