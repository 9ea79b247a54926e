// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/status/watchdog_rule.hpp"
#include "service_notify.hpp"

namespace terracut::cli {

/// A live run as a systemd service: reports readiness and status, and feeds the watchdog while
/// frames are in time. Outside a service it does nothing. One thread, the main one; never blocks.
class LiveService {
 public:
  /// Reads the environment. If a service manager cannot be reached, warns, and the run goes on
  /// without it.
  [[nodiscard]] static LiveService from_environment();
  explicit LiveService(ServiceNotify notify) noexcept;

  /// Call this once the run is listening. `now_ns` is measure::monotonic_ns(), here and below.
  void ready(const status::MonitorSnapshot& figures, std::int64_t now_ns);
  /// Call it at any rate: it examines the figures four times within the watchdog's time, or every
  /// five seconds without a watchdog.
  void work_round(const status::MonitorSnapshot& figures, std::int64_t now_ns);
  /// Call this once, before the threads end.
  void stopping() const noexcept { notify_.stopping(); }

 private:
  ServiceNotify notify_;
  status::WatchdogRule rule_;
  std::int64_t look_every_ns_;
  std::int64_t next_look_ns_ = 0;
};

}  // namespace terracut::cli
