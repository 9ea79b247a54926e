// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>

#include "firmware_io/frame/label.hpp"
#include "pipeline/live/frame_pool.hpp"
#include "pipeline/output/frame_folder.hpp"
#include "rt/error.hpp"
#include "rt/threads/background_thread.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Writes the labels of every frame to a folder on a thread of its own, so that no other thread
/// waits for the disk. If it cannot write, or other programs need the remaining space
/// (files::check_room_left), it warns and tries again every second. FramePool counts the frames not
/// written.
class LabelWriter {
 public:
  using Slots = live::FramePool<frame::Label>;

  /// `slots` must outlive this object.
  LabelWriter(const OutputOptions& options, Slots& slots);
  ~LabelWriter() { finish_ = true; }

  /// Writes the remaining frames; call it after LiveThreads::stop(). Returns false if the disk does
  /// not answer; the process must then end without destroying this object.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);
  /// Returns, after finish(), the error of the first file that could not be written.
  [[nodiscard]] const Status& outcome() const noexcept { return outcome_; }

 private:
  void work();
  [[nodiscard]] bool write(const Slots::Frame& frame);
  [[nodiscard]] Status try_to_write(const Slots::Frame& frame);

  std::filesystem::path place_;
  output::FrameFolder folder_;
  Slots& slots_;
  std::atomic<bool> finish_{false};
  Status outcome_;
  std::int64_t try_again_ns_ = 0;     ///< 0 if the newest frame was written.
  threads::BackgroundThread thread_;  ///< Declared last: uses all members above.
};

}  // namespace terracut::cli
