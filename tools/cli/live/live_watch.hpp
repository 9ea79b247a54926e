// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "health_reporter.hpp"
#include "live_options.hpp"
#include "live_threads.hpp"
#include "pipeline/segmenter.hpp"
#include "rt/deadline_monitor.hpp"
#include "rt/status_page.hpp"
#include "tools/cli/metrics_server.hpp"
#include "vehicle_motion.hpp"

namespace terracut::cli {

/// Judges the frames of a live run and keeps its figures where others can see them: the status
/// page, /metrics and, in short, a CAN bus. One thread, the main one; touches no disk.
class LiveWatch {
 public:
  static constexpr std::array<std::string_view, pipeline::kStages> kStageNames{
      to_string(pipeline::Stage::kElevationMap), to_string(pipeline::Stage::kAdjacentPoints),
      to_string(pipeline::Stage::kSeeds), to_string(pipeline::Stage::kMinCut),
      to_string(pipeline::Stage::kLabels)};

  /// All must outlive this. `motion` may be null.
  LiveWatch(const LiveOptions& options, LiveThreads& threads, VehicleMotion* motion,
            rt::FixedMemory& memory);

  /// Status page, /metrics, health on a CAN bus: what fails is said, and the run goes on without
  /// it.
  void open(const std::string& sensor, const std::string& input);

  struct Round {
    int frames = 0;  ///< Judged.
    int missed = 0;  ///< Of them, deadlines.
  };
  /// Takes what has come since the last round.
  Round turn_round();
  /// After everything that takes results has ended, or will not.
  void last_round();

  [[nodiscard]] const rt::MonitorSnapshot& figures() const noexcept { return monitor_.snapshot(); }
  /// The times of the newest frames, oldest first.
  [[nodiscard]] std::vector<rt::FrameTiming> newest() const;

 private:
  static constexpr std::size_t kKeptFrames = 256;

  void open_page();
  void open_metrics();
  void open_health();
  void refresh();
  void refresh_link(rt::MonitorSnapshot& figures);
  void refresh_losses(rt::MonitorSnapshot& figures);
  void refresh_threads(rt::MonitorSnapshot& figures);

  const LiveOptions& options_;
  LiveThreads& threads_;
  VehicleMotion* motion_;
  bool over_ = false;
  rt::DeadlineMonitor monitor_;
  std::optional<rt::StatusPagePublisher<rt::MonitorSnapshot>> page_;
  std::optional<HealthReporter> health_;
  std::mutex
      shown_mutex_;  ///< Between this thread and the metrics server's; neither has a deadline.
  std::unique_ptr<rt::MonitorSnapshot> shown_;
  std::optional<MetricsServer> metrics_;  ///< Last: it reads shown_ until it is gone.
};

}  // namespace terracut::cli
