// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "recorded_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "tools/cli/settings/motion_choice.hpp"

namespace terracut::cli {
namespace {

/// If the stamps of one recording step back, the other may step back up to this much later: then
/// both show the same step of the clock.
constexpr std::int64_t kTogether_ns = 1'000'000'000;

/// Fails if no frame of the recording has any of the signals; the message says what was found.
Status find_signals(const std::filesystem::path& path, std::span<const can::CanId> ids) {
  auto recording = can::CanRecording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  auto frame = recording->next();
  for (; frame && *frame; frame = recording->next()) {
    if ((*frame)->is_data() && std::ranges::find(ids, (*frame)->id) != ids.end()) return {};
  }
  if (!frame) return tl::unexpected(frame.error());
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: none of its {} frames holds the signals that motion.speed and "
                          "motion.yaw_rate name",
                          path.string(), recording->counters().delivered));
}

}  // namespace

Expected<RecordedMotion> RecordedMotion::open(const Options& options, memory::FixedMemory& memory) {
  auto signals = motion_signals_of(options.motion);
  if (!signals) return tl::unexpected(signals.error());
  auto recording = can::CanRecording::open(options.can_recording);
  if (!recording) return tl::unexpected(recording.error());
  if (Status found = find_signals(options.can_recording, signals->ids()); !found) {
    return tl::unexpected(found.error());
  }
  return RecordedMotion(options.can_recording, *std::move(recording), *std::move(signals),
                        ego_motion_config_of(options.motion), memory);
}

RecordedMotion::RecordedMotion(std::filesystem::path path, can::CanRecording recording,
                               vehicle::MotionSignals signals,
                               const vehicle::EgoMotion::Config& config,
                               memory::FixedMemory& memory)
    : path_(std::move(path)),
      recording_(std::move(recording)),
      signals_(std::move(signals)),
      motion_(std::make_unique<vehicle::EgoMotion>(config, memory)) {
  read_on();
}

Status RecordedMotion::restart() {
  auto recording = can::CanRecording::open(path_);
  if (!recording) return tl::unexpected(recording.error());
  recording_ = *std::move(recording);
  frames_ = packets_ = {};
  read_on();
  return {};
}

void RecordedMotion::Steps::note(std::int64_t stamp_ns) noexcept {
  if (newest_ns != kNone && newest_ns - stamp_ns > vehicle::kMotionDisorder_ns) {
    ++count;
    left_off_ns = newest_ns;
    newest_ns = stamp_ns;
  }
  newest_ns = std::max(newest_ns, stamp_ns);
}

bool RecordedMotion::next_is_due() noexcept {
  if (frames_.count < packets_.count) {  // the frames' clock has not been set back yet
    if (next_->stamp_ns - packets_.left_off_ns <= kTogether_ns) return true;
    frames_.count = packets_.count;
  } else if (frames_.count > packets_.count) {
    if (packets_.newest_ns - frames_.left_off_ns <= kTogether_ns) return false;
    packets_.count = frames_.count;
  }
  return next_->stamp_ns <= packets_.newest_ns;
}

void RecordedMotion::hear_until(std::int64_t stamp_ns) {
  packets_.note(stamp_ns);
  for (; next_ && next_is_due(); read_on()) {
    if (const auto sample = signals_.take(*next_)) (void)motion_->add(*sample);
    motion_->take_new();  // reader and writer are one thread here, so the queue never fills
  }
}

void RecordedMotion::read_on() {
  next_.reset();
  auto frame = recording_.next();
  if (frame) {
    next_ = *std::move(frame);
    if (next_) frames_.note(next_->stamp_ns);
  } else {
    fault_ = frame.error().message;
  }
}

std::string RecordedMotion::warnings() const {
  std::string text;
  const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
  if (!fault_.empty()) add(fault_);
  if (const auto& log = recording_.counters(); log.malformed > 0) {
    add(fmt::format("{}: {} of {} records are malformed; the first: {}", path_.string(),
                    log.malformed, log.records, recording_.first_fault()));
  }
  const vehicle::MotionCounters& counters = signals_.counters();
  if (counters.frames == 0) {
    add(
        fmt::format("{}: none of its frames up to the capture's end holds the signals that "
                    "motion.speed and motion.yaw_rate name",
                    path_.string()));
  }
  for (const auto& [what, count] :
       {std::pair{"frames are too short for their signals", counters.too_short},
        std::pair{"signals came out of order", counters.out_of_order},
        std::pair{"yaw rates were marked invalid", counters.yaw_rate_invalid},
        std::pair{"speeds were marked invalid", counters.speed_invalid},
        std::pair{"yaw rates came without a fresh speed", counters.stale},
        std::pair{"samples are faster than any car", motion_->counters().implausible}}) {
    if (count > 0) add(fmt::format("{}: {} {}", path_.string(), count, what));
  }
  return text;
}

}  // namespace terracut::cli
