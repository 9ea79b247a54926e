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

/// Plays a recording at its own speed, or as it is told: stands, steps, goes elsewhere. At the end
/// it begins anew or, where it is told to, stands.
class CapturePlayer : public ViewedCapture {
 public:
  using OnFrame = std::function<Status(const publish::LabelledFrame& frame)>;

  /// `recording` must outlive it; a thread measures it meanwhile.
  explicit CapturePlayer(PlayedRecording& recording);
  ~CapturePlayer() override;

  /// Until stop_wanted(); each frame when its time has come. The errors of the recording and
  /// of on_frame; kNothingCameOut where it has no frame.
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
  PlayerState state_;             ///< Guarded by mutex_, as what follows.
  std::optional<double> seek_s_;  ///< Where it is to go.
  int steps_ = 0;                 ///< Frames to show though it stands.
  std::uint64_t commands_ = 0;
  bool is_measured_ = false;

  bool has_frames_ = false;
  /// Frames that end before that time are not shown.
  std::int64_t skip_to_ns_ = std::numeric_limits<std::int64_t>::min();
  /// When which frame was due, by its time in the capture.
  std::optional<std::pair<Clock::time_point, std::int64_t>> pace_;
  std::int64_t shown_ns_ = 0;  ///< Of the frame that was waited for last.
  std::atomic<bool> stop_measuring_{false};
  std::jthread measuring_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
