// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "capture_player.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

constexpr std::chrono::milliseconds kMoment{50};
constexpr std::chrono::seconds kMeasuredAhead{1};
/// A longer gap in a capture means that its clock was set.
constexpr std::int64_t kLongestPause_ns = 60'000'000'000;

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

}  // namespace

CapturePlayer::CapturePlayer(PlayedRecording& recording) : recording_(recording) {
  state_.frame_s = recording.frame_s();
  try {
    measuring_ = std::jthread([this] { measure(); });
  } catch (const std::system_error&) {  // no thread left; the player works without the length
    is_measured_ = true;
  }
  // Waits a little, so that a short recording's length is known before a viewer asks for it.
  std::unique_lock lock(mutex_);
  told_.wait_for(lock, kMeasuredAhead, [&] { return is_measured_; });
}

CapturePlayer::~CapturePlayer() {
  stop_measuring_ = true;
}

void CapturePlayer::measure() {
  recording_.measure([this](std::int64_t begin_stamp_ns, std::int64_t length_ns) {
    const std::lock_guard lock(mutex_);
    state_.begin_ns = begin_stamp_ns;
    state_.duration_s = seconds(length_ns);
    return !stop_measuring_;
  });
  const std::lock_guard lock(mutex_);
  is_measured_ = true;
  told_.notify_all();
}

void CapturePlayer::obey(const PlayerCommand& command) {
  const std::lock_guard lock(mutex_);
  if (command.playing) {
    state_.playing = *command.playing;
    if (state_.playing && state_.at_end && !command.seek_s) seek_s_ = 0;
  }
  if (command.rate) state_.rate = *command.rate;
  if (command.loop) state_.loop = *command.loop;
  if (command.seek_s) seek_s_ = command.seek_s;
  if (command.step) state_.playing = false;
  if (command.seek_s) steps_ = state_.playing ? 0 : 1;
  if (command.step) ++steps_;
  state_.seeking = seek_s_ || steps_ > 0;
  ++commands_;
  told_.notify_all();
}

PlayerState CapturePlayer::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Status CapturePlayer::run(const OnFrame& on_frame) {
  PlayedFrame frame;
  while (!stop_wanted()) {
    std::optional<double> seek_s;
    {
      std::unique_lock lock(mutex_);
      const auto has_work = [&] {
        return seek_s_ || steps_ > 0 || (state_.playing && !state_.at_end);
      };
      if (!told_.wait_for(lock, kMoment, has_work)) continue;
      // A seek is done after the first frame, which shows where frames begin in the capture.
      if (has_frames_) seek_s = std::exchange(seek_s_, std::nullopt);
    }
    if (seek_s) {
      if (Status gone = go_to(*seek_s); !gone) return gone;
    }
    const auto span = next_due();
    if (!span && !has_frames_ && !stop_wanted()) return recording_.conclude();
    if (!span) continue;
    Status taken = recording_.take(frame);
    if (taken) taken = on_frame(frame);
    if (!taken) return taken;
    const std::lock_guard lock(mutex_);
    state_.frame = frame.record.info.number;
    state_.position_s = std::max(0.0, seconds(span->begin_ns));
    state_.seeking = seek_s_ || steps_ > 0;
  }
  return {};
}

Status CapturePlayer::go_to(double seek_s) {
  skip_to_ns_ = static_cast<std::int64_t>((seek_s + recording_.frame_s() / 2) * 1e9);
  if (Status status = recording_.go_to(seek_s); !status) return status;
  pace_.reset();
  const std::lock_guard lock(mutex_);
  state_.at_end = false;
  return {};
}

/// Waits until the next frame is due and returns it; none if a command came meanwhile, or at the
/// end.
std::optional<PlayedRecording::Span> CapturePlayer::next_due() {
  auto span = recording_.next();
  has_frames_ = has_frames_ || span;
  while (span && span->end_ns < skip_to_ns_) span = recording_.next();
  skip_to_ns_ = std::numeric_limits<std::int64_t>::min();
  if (!span) {
    end_or_begin_anew();
  } else if (!wait_until_due(span->begin_ns)) {
    span.reset();
  }
  return span;
}

void CapturePlayer::end_or_begin_anew() {
  const auto frame_ns = static_cast<std::int64_t>(recording_.frame_s() * 1e9);
  std::unique_lock lock(mutex_);
  if (seek_s_ || stop_wanted()) return;  // a seek or a stop, not the end
  const bool is_stepped = steps_ > 0;
  if (state_.loop && has_frames_) {
    lock.unlock();
    const bool is_over = wait_until_due(shown_ns_ + frame_ns);
    lock.lock();
    if (!is_over || seek_s_) return;
    if (state_.loop) {
      seek_s_ = 0;
      steps_ = is_stepped || !state_.playing ? 1 : 0;
      return;
    }
  }
  state_.at_end = true;
  state_.seeking = false;
  steps_ = 0;
  state_.playing = false;
}

bool CapturePlayer::wait_until_due(std::int64_t since_begin_ns) {
  std::unique_lock lock(mutex_);
  while (!stop_wanted()) {
    if (seek_s_) return false;
    if (since_begin_ns - shown_ns_ > kLongestPause_ns) pace_.reset();
    if (steps_ > 0) {
      --steps_;  // counted now, as a later command may set the steps anew
      pace_.reset();
      shown_ns_ = since_begin_ns;
      return true;
    }
    const std::uint64_t commands = commands_;
    if (!state_.playing) {
      pace_.reset();
      told_.wait_for(lock, kMoment);
      continue;
    }
    const auto now = Clock::now();
    if (!pace_ || since_begin_ns < pace_->second) pace_ = {now, since_begin_ns};
    shown_ns_ = since_begin_ns;
    const auto due =
        pace_->first + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                           seconds(since_begin_ns - pace_->second) / state_.rate));
    if (due <= now) {
      // If labelling is slower than the recording, the pace begins anew instead of catching up.
      if (now - due > std::chrono::seconds(1)) pace_ = {now, since_begin_ns};
      return true;
    }
    told_.wait_until(lock, std::min(due, now + kMoment));
    if (commands != commands_) pace_.reset();  // a command may have changed the rate
  }
  return false;
}

}  // namespace terracut::cli
