// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "figures_display.hpp"
#include "health_reporter.hpp"
#include "link_news.hpp"
#include "live_options.hpp"
#include "live_threads.hpp"
#include "pipeline/segmenter.hpp"
#include "rt/deadline_monitor.hpp"
#include "rt/stolen_time.hpp"
#include "standing_head.hpp"
#include "stolen_time_share.hpp"
#include "stream_writer.hpp"
#include "tools/cli/mount_watch.hpp"
#include "vehicle_motion.hpp"

namespace terracut::cli {

/// Judges the frames of a live run and shows its figures: on the display and, in short, on a CAN
/// bus. Says when the sensor falls silent and when it is back. One thread, the main one; touches no
/// disk.
class LiveWatch {
 public:
  static constexpr std::array<std::string_view, pipeline::kStages> kStageNames{
      to_string(pipeline::Stage::kElevationMap), to_string(pipeline::Stage::kAdjacentPoints),
      to_string(pipeline::Stage::kSeeds), to_string(pipeline::Stage::kMinCut),
      to_string(pipeline::Stage::kLabels)};

  /// All must outlive this. `motion` may be null.
  LiveWatch(const LiveOptions& options, const calib::Mount& mount, LiveThreads& threads,
            VehicleMotion* motion, FiguresDisplay& display, rt::FixedMemory& memory);

  /// Health on a CAN bus: where it fails that is said, and the run goes on without it. `stream`:
  /// whose losses are shown as well; may be null, and must outlive this.
  void open(const std::string& sensor, const std::string& input, const StreamWriter* stream);

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

  void open_health();
  void refresh();
  void refresh_link(rt::MonitorSnapshot& figures);
  void refresh_losses(rt::MonitorSnapshot& figures);
  void refresh_threads(rt::MonitorSnapshot& figures);

  const LiveOptions& options_;
  LiveThreads& threads_;
  VehicleMotion* motion_;
  const StreamWriter* stream_ = nullptr;
  FiguresDisplay& display_;
  std::unique_ptr<MountWatch> mount_;
  StandingHead standing_head_;
  LinkNews link_news_;
  std::optional<StolenTimeShare<rt::StolenTime>> stolen_;
  bool over_ = false;
  rt::DeadlineMonitor monitor_;
  std::optional<HealthReporter> health_;
};

}  // namespace terracut::cli
