// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "played_recording.hpp"
#include "viewed_capture.hpp"

namespace terracut::cli {

/// Plays a recording at its own speed, or as commanded (pause, step, seek). At the end it starts
/// over or, if so commanded, pauses.
class CapturePlayer : public ViewedCapture {
 public:
  using OnFrame = std::function<Status(const PlayedFrame& frame)>;

  /// `recording` must outlive this object, which measures its length on a thread of its own.
  explicit CapturePlayer(PlayedRecording& recording);
  ~CapturePlayer() override;

  /// Plays until stop_wanted(), each frame at its time. Fails with the errors of the recording and
  /// of on_frame; kNothingCameOut if it has no frame.
  [[nodiscard]] Status run(const OnFrame& on_frame);

  void obey(const PlayerCommand& command) override;
  [[nodiscard]] PlayerState state() const override;

 private:
  using Clock = std::chrono::steady_clock;

  void measure();
  [[nodiscard]] Status go_to(double seek_s);
  [[nodiscard]] std::optional<PlayedRecording::Span> next_due();
  [[nodiscard]] bool wait_until_due(std::int64_t since_begin_ns);
  void end_or_begin_anew();

  PlayedRecording& recording_;
  mutable std::mutex mutex_;
  std::condition_variable told_;
  PlayerState state_;             ///< Guarded by mutex_, as are the next members.
  std::optional<double> seek_s_;  ///< Time to seek to.
  int steps_ = 0;                 ///< Frames still to be shown while paused.
  std::uint64_t commands_ = 0;
  bool is_measured_ = false;

  bool has_frames_ = false;
  /// Frames that end before this time are not shown.
  std::int64_t skip_to_ns_ = std::numeric_limits<std::int64_t>::min();
  /// The time at which a frame was due, and that frame's time in the capture.
  std::optional<std::pair<Clock::time_point, std::int64_t>> pace_;
  std::int64_t shown_ns_ = 0;  ///< Time of the last frame waited for.
  std::atomic<bool> stop_measuring_{false};
  std::jthread measuring_;  ///< Declared last: uses all members above.
};

}  // namespace terracut::cli
