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

/// Returns folder and limits for a run's dumps, whose names begin with the run's name.
[[nodiscard]] recorder::DumpFolderLimits dump_folder_of(const Options& options);

/// Writes the flight recorder's dumps on a thread of its own, so that no other thread waits for the
/// disk. Dumps requested while one is being written lead to one more dump after it.
class DumpWriter {
 public:
  /// `recorder`, `stage_names` and `answers` are used by this object alone and must outlive it.
  /// `calibration` is the table in use, which is written beside each dump.
  DumpWriter(const Options& options, calib::SensorCalibration calibration,
             recorder::FlightRecorder& recorder, std::span<const std::string_view> stage_names,
             DumpAnswers& answers);
  ~DumpWriter() { begin_to_finish(); }

  /// Requests a dump; `frames` are the records of the newest frames, for their times.
  void want(recorder::DumpReason reason, std::vector<status::FrameRecord> frames);

  /// False if the disk does not answer; the process must then end without destroying this object.
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

  std::mutex mutex_;  ///< Shared by threads without a deadline.
  std::condition_variable changed_;
  std::array<bool, recorder::kDumpReasons> wanted_{};
  std::vector<status::FrameRecord> frames_;
  bool finish_ = false;

  threads::BackgroundThread thread_;  ///< Declared last: uses all members above.
};

}  // namespace terracut::cli
