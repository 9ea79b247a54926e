// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "capture_player.hpp"

#include <algorithm>
#include <utility>

#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

constexpr std::chrono::milliseconds kMoment{50};
constexpr std::chrono::seconds kMeasuredAhead{1};
/// Where a capture shows nothing for longer, its clock was set.
constexpr std::int64_t kLongestPause_ns = 60'000'000'000;

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

}  // namespace

CapturePlayer::CapturePlayer(LabelledCapture& capture, const CaptureOptions& options)
    : capture_(capture), options_(options) {
  if (const double spin_hz = capture.capture().sensor.spin_hz; spin_hz > 0) {
    state_.frame_s = 1 / spin_hz;
  }
  measuring_ = std::thread([this] { measure(); });
  // How long a short one is, whoever looks at it knows from the first.
  std::unique_lock lock(mutex_);
  told_.wait_for(lock, kMeasuredAhead, [&] { return is_measured_; });
}

CapturePlayer::~CapturePlayer() {
  stop_measuring_ = true;
  measuring_.join();
}

/// A capture says nowhere how long it is.
void CapturePlayer::measure() {
  auto source = open_again(capture_.capture(), options_);
  constexpr std::uint64_t kPacketsAtOnce = 4096;
  capture::CaptureClock clock;
  std::int64_t longest_ns = 0;
  for (std::uint64_t read = 0; source && !stop_measuring_; ++read) {
    const auto next = source->next();
    if (!next || !*next) break;
    if (read == 0) {
      const std::lock_guard lock(mutex_);
      state_.begin_ns = (*next)->stamp_ns;
    }
    longest_ns = std::max(longest_ns, clock.add((*next)->stamp_ns));
    if (read % kPacketsAtOnce == 0) note_duration(longest_ns);
  }
  note_duration(longest_ns);
  const std::lock_guard lock(mutex_);
  is_measured_ = true;
  told_.notify_all();
}

void CapturePlayer::note_duration(std::int64_t so_far_ns) {
  const std::lock_guard lock(mutex_);
  state_.duration_s = seconds(so_far_ns);
}

void CapturePlayer::obey(const PlayerCommand& command) {
  const std::lock_guard lock(mutex_);
  if (command.playing) {
    state_.playing = *command.playing;
    if (state_.playing && state_.at_end && !command.seek_s) seek_s_ = 0;
  }
  if (command.rate) state_.rate = *command.rate;
  if (command.seek_s) seek_s_ = command.seek_s;
  if (command.step) state_.playing = false;
  if (command.seek_s) steps_ = state_.playing ? 0 : 1;
  if (command.step) ++steps_;
  ++commands_;
  told_.notify_all();
}

PlayerState CapturePlayer::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Status CapturePlayer::run(const OnFrame& on_frame) {
  while (!stop_wanted()) {
    std::optional<double> seek_s;
    {
      std::unique_lock lock(mutex_);
      const auto has_work = [&] {
        return seek_s_ || steps_ > 0 || (state_.playing && !state_.at_end);
      };
      if (!told_.wait_for(lock, kMoment, has_work)) continue;
      // Where a place in the capture is, is known from its first frame on.
      if (has_frames_) seek_s = std::exchange(seek_s_, std::nullopt);
    }
    if (seek_s) {
      if (Status gone = go_to(*seek_s); !gone) return gone;
    }
    const run::Frame* frame = next_due();
    if (frame == nullptr && !has_frames_) return capture_.conclude();
    if (frame == nullptr) continue;
    if (Status taken = on_frame(*frame, capture_.labels()); !taken) return taken;
    const std::lock_guard lock(mutex_);
    state_.position_s =
        std::max(0.0, seconds(capture_.since_begin_ns(frame->record.info.first_packet_ns)));
  }
  return {};
}

Status CapturePlayer::go_to(double seek_s) {
  // A frame more, because the first one begins somewhere within a revolution and is not shown.
  const double frame_s = state().frame_s;
  skip_to_ns_ = static_cast<std::int64_t>((seek_s + frame_s / 2) * 1e9);
  if (Status status = capture_.rewind(std::max(0.0, seek_s - 1.25 * frame_s)); !status) {
    return status;
  }
  pace_.reset();
  const std::lock_guard lock(mutex_);
  state_.at_end = false;
  return {};
}

/// The next frame once its time has come; null: something else is wanted meanwhile, or there is
/// none.
const run::Frame* CapturePlayer::next_due() {
  const run::Frame* frame = capture_.next();
  has_frames_ = has_frames_ || frame != nullptr;
  while (frame != nullptr &&
         capture_.since_begin_ns(frame->record.info.last_packet_ns) < skip_to_ns_) {
    frame = capture_.next();
  }
  skip_to_ns_ = std::numeric_limits<std::int64_t>::min();
  if (frame == nullptr) {
    const std::lock_guard lock(mutex_);
    if (seek_s_) return nullptr;  // told meanwhile, and no end for it
    state_.at_end = true;
    steps_ = 0;
    state_.playing = false;
    return nullptr;
  }
  const std::int64_t due_ns = capture_.since_begin_ns(frame->record.info.first_packet_ns);
  return wait_until_due(due_ns) ? frame : nullptr;
}

bool CapturePlayer::wait_until_due(std::int64_t since_begin_ns) {
  std::unique_lock lock(mutex_);
  while (!stop_wanted()) {
    if (seek_s_) return false;
    if (since_begin_ns - shown_ns_ > kLongestPause_ns) pace_.reset();
    if (steps_ > 0) {
      --steps_;  // here, where no later command's step is meant
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
      // Where labels come more slowly than frames did, the capture takes its time.
      if (now - due > std::chrono::seconds(1)) pace_ = {now, since_begin_ns};
      return true;
    }
    told_.wait_until(lock, std::min(due, now + kMoment));
    if (commands != commands_) pace_.reset();  // another rate perhaps: it holds from here on
  }
  return false;
}

}  // namespace terracut::cli
