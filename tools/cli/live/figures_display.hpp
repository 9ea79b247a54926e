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

/// Keeps a run's figures where others can see them: the status page and /metrics. From the start
/// on, so that who looks finds a run that waits for its sensor. One thread; touches no disk.
class FiguresDisplay {
 public:
  /// What cannot be opened is warned of and tried again, and the run goes on without it.
  explicit FiguresDisplay(const WatchOptions& options);

  void show(const status::MonitorSnapshot& figures);
  /// Requests that /metrics refused.
  void add_losses(status::MonitorSnapshot& figures);

 private:
  using Page = page::StatusPagePublisher<status::MonitorSnapshot>;
  [[nodiscard]] publish::Reopened<HttpServer>::Config metrics_at(const std::string& endpoint);

  publish::Reopened<Page> page_;
  std::mutex
      shown_mutex_;  ///< Between this thread and the metrics server's; neither has a deadline.
  std::unique_ptr<status::MonitorSnapshot> shown_ = std::make_unique<status::MonitorSnapshot>();
  /// Last: it reads shown_ until it is gone.
  std::optional<publish::Reopened<HttpServer>> metrics_;
};

}  // namespace terracut::cli
