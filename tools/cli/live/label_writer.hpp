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

/// Writes the labels of every frame to a folder, on a thread of its own: however long the disk
/// takes, nothing waits for it. Where it cannot, or others need the room that is left
/// (files::check_room_left), that is said, and tried again every second. Frames that are not
/// written are counted by FramePool.
class LabelWriter {
 public:
  using Slots = live::FramePool<frame::Label>;

  /// `slots` must outlive this.
  LabelWriter(const OutputOptions& options, Slots& slots);
  ~LabelWriter() { finish_ = true; }

  /// After LiveThreads::stop(): writes what is left. False when the disk does not answer; then the
  /// process must end without destroying this.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);
  /// After finish(): the first file that could not be written.
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
  std::int64_t try_again_ns_ = 0;     ///< 0: the newest frame was written.
  threads::BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
