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

#include "calib/sensor_calibration.hpp"
#include "pipeline/recorder/dump_policy.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/status/frame_record.hpp"
#include "rt/threads/background_thread.hpp"
#include "tools/cli/commands/dump_answer.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Where a run's dumps go, under its name.
[[nodiscard]] recorder::DumpFolderLimits dump_folder_of(const Options& options);

/// Writes the flight recorder's dumps on a thread of its own: however long the disk takes, nothing
/// waits for it. What is wanted while a dump is being written is written after it, once.
class DumpWriter {
 public:
  /// `recorder`, `stage_names` and `answers`, which only this uses meanwhile, must outlive this.
  /// `calibration`, in use, goes beside each dump.
  DumpWriter(const Options& options, calib::SensorCalibration calibration,
             recorder::FlightRecorder& recorder, std::span<const std::string_view> stage_names,
             DumpAnswers& answers);
  ~DumpWriter() { begin_to_finish(); }

  /// `frames`: the times of the newest frames.
  void want(recorder::DumpReason reason, std::vector<status::FrameRecord> frames);

  /// False when the disk does not answer; then the process must end without destroying this.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);

 private:
  void begin_to_finish();
  void work();
  void dump(recorder::DumpReason reason, const std::vector<status::FrameRecord>& frames);
  void add_table(recorder::DumpReport& dump) const;

  calib::SensorCalibration calibration_;
  recorder::FlightRecorder& recorder_;
  std::span<const std::string_view> stage_names_;
  recorder::DumpPolicy policy_;
  DumpAnswers& answers_;

  std::mutex mutex_;  ///< Between threads without a deadline.
  std::condition_variable changed_;
  std::array<bool, recorder::kDumpReasons> wanted_{};
  std::vector<status::FrameRecord> frames_;
  bool finish_ = false;

  threads::BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
