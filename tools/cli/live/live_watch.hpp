// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "figures_display.hpp"
#include "pipeline/health/health_reporter.hpp"
#include "pipeline/live/frame_outlet.hpp"
#include "pipeline/live/live_parts.hpp"
#include "pipeline/status/input_status.hpp"
#include "pipeline/status/stolen_time_share.hpp"
#include "pipeline/visibility/sight_news.hpp"
#include "rt/measure/stolen_time.hpp"
#include "tools/cli/input/mount_watch.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Judges the frames of a live run and shows its figures on the display and, in short form, on a
/// CAN bus. Reports when the sensor falls silent and when it is back. One thread, the main one;
/// touches no disk.
class LiveWatch {
 public:
  /// All arguments must outlive this object.
  LiveWatch(const Options& options, const mount::Mount& mount, const MountChoice& choice,
            live::LiveParts& parts, FiguresDisplay& display);

  /// Opens health reports on a CAN bus; if that fails, warns, and the run goes on without them.
  /// From now on shows the losses of `outlet`, which may be null, and of `publisher`, and how far
  /// the sensor sees by `outlet`; hands the figures to `publisher` every second, and whenever the
  /// sensor's view becomes another. Both must outlive this object.
  void open(const std::string& sensor, const std::string& input, const live::FrameOutlet* outlet,
            publish::Publisher& publisher);

  struct Round {
    int frames = 0;  ///< Frames judged.
    int missed = 0;  ///< Judged frames that missed the deadline.
  };
  /// Processes the results that came since the last round.
  Round work_round();
  /// Notes that the run ended before the requested time.
  void note_interruption() { parts_.monitor.snapshot().interrupted = 1; }
  /// Processes the last results; call it when all threads that take results have ended or hang.
  void last_round();

  [[nodiscard]] const status::MonitorSnapshot& figures() const noexcept {
    return parts_.monitor.snapshot();
  }
  /// Returns the times of the newest frames, oldest first.
  [[nodiscard]] std::vector<status::FrameRecord> newest() const;

 private:
  void open_health();
  void refresh();
  void publish_figures();
  void refresh_input(status::MonitorSnapshot& figures);
  void refresh_losses(status::MonitorSnapshot& figures);
  void refresh_threads(status::MonitorSnapshot& figures);
  void refresh_sight(status::MonitorSnapshot& figures);

  const Options& options_;
  live::LiveParts& parts_;
  const live::FrameOutlet* outlet_ = nullptr;
  publish::Publisher* publisher_ = nullptr;
  std::int64_t publish_figures_at_ns_ = 0;  ///< CLOCK_MONOTONIC
  FiguresDisplay& display_;
  std::unique_ptr<MountWatch> mount_;
  visibility::SightNews sight_news_;
  status::InputStatus input_;
  std::optional<status::StolenTimeShare<measure::StolenTime>> stolen_;
  bool over_ = false;
  std::optional<health::HealthReporter> health_;
};

}  // namespace terracut::cli
