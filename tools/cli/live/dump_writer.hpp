// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "background_thread.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/live/dump_policy.hpp"
#include "firmware_io/live/flight_recorder.hpp"
#include "live_options.hpp"
#include "rt/frame_timing.hpp"
#include "tools/cli/dump_answer.hpp"

namespace terracut::cli {

/// Where a run's dumps go, under its name.
[[nodiscard]] firmware_io::DumpFolderLimits dump_folder_of(const LiveOptions& options);

/// Writes the flight recorder's dumps on a thread of its own: however long the disk takes, nothing
/// waits for it. What is wanted while a dump is being written is written after it, once.
class DumpWriter {
 public:
  /// `recorder` and `stage_names` must outlive this. `calibration`, in use, goes beside each dump.
  DumpWriter(const LiveOptions& options, calib::SensorCalibration calibration,
             firmware_io::FlightRecorder& recorder, std::span<const std::string_view> stage_names);

  /// `frames`: the times of the newest frames.
  void want(firmware_io::DumpReason reason, std::vector<rt::FrameTiming> frames);

  /// False when the disk does not answer; then the process must end without destroying this.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);

 private:
  void work();
  void dump(firmware_io::DumpReason reason, const std::vector<rt::FrameTiming>& frames);
  void add_table(firmware_io::DumpReport& dump) const;

  calib::SensorCalibration calibration_;
  firmware_io::FlightRecorder& recorder_;
  std::span<const std::string_view> stage_names_;
  firmware_io::DumpPolicy policy_;
  DumpAnswers answers_;

  std::mutex mutex_;  ///< Between threads without a deadline.
  std::condition_variable changed_;
  std::array<bool, firmware_io::kDumpReasons> wanted_{};
  std::vector<rt::FrameTiming> frames_;
  bool finish_ = false;

  BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
