// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "firmware_io/can/can_sender.hpp"
#include "pipeline/status/bus_figures.hpp"
#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::health {

/// Reports the health of a live run on a CAN bus (pipeline/health/terracut_health.dbc): the newest
/// frame whenever frames were judged, and four times a second if no frames come; with it the
/// sensor's view, if that is watched. So a counter that stands still means a dead process. Never
/// waits. For one thread without a deadline.
class HealthReporter {
 public:
  /// `bus` is the name of the CAN bus, for show().
  HealthReporter(std::string bus, can::CanSender sender);

  /// Sends the reports that are due; may be called at any rate. `now_ns` is
  /// measure::monotonic_ns().
  void work_round(const status::MonitorSnapshot& figures, const status::FrameRecord& newest,
                  std::int64_t now_ns) noexcept;

  void show(status::HealthFigures& figures) const noexcept;

 private:
  static constexpr std::int64_t kLongestSilence_ns = 250'000'000;

  std::string bus_;
  can::CanSender sender_;
  std::uint32_t alive_ = 0;
  std::uint64_t reported_frames_ = 0;
  std::int64_t next_report_ns_ = 0;
};

}  // namespace terracut::health
