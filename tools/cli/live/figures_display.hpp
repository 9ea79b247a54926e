// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "pipeline/page/status_page.hpp"
#include "pipeline/publish/reopened.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "tools/cli/export/metrics_server.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Shows a run's figures on the status page and /metrics, from the start on, so that a run that
/// waits for its sensor is visible too. One thread; touches no disk.
class FiguresDisplay {
 public:
  /// Opens the outputs. Warns of one that cannot be opened and tries it again; the run goes on
  /// without it.
  explicit FiguresDisplay(const WatchOptions& options);

  void show(const status::MonitorSnapshot& figures);
  /// Adds the number of requests that /metrics has refused to the losses in `figures`.
  void add_losses(status::MonitorSnapshot& figures);

 private:
  using Page = page::StatusPagePublisher<status::MonitorSnapshot>;
  [[nodiscard]] publish::Reopened<HttpServer>::Config metrics_at(const std::string& endpoint);

  publish::Reopened<Page> page_;
  std::mutex
      shown_mutex_;  ///< Shared by this thread and the metrics server's; neither has a deadline.
  std::unique_ptr<status::MonitorSnapshot> shown_ = std::make_unique<status::MonitorSnapshot>();
  /// Declared last, because its thread reads shown_ until it ends.
  std::optional<publish::Reopened<HttpServer>> metrics_;
};

}  // namespace terracut::cli
