// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/deadline_monitor.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace terracut::status {
namespace {

constexpr double kSecond_ns = 1e9;
constexpr std::size_t kRateFrames = 50;
constexpr std::int64_t kRateWindow_ns = 5'000'000'000;  // frames older than this lie before a gap
constexpr std::int64_t kStopped_ns = 1'000'000'000;  // the slowest head rotates five times in this

/// Takes up to `wanted_ns` off `rest_ns` and returns the amount taken.
std::int64_t take_share(std::int64_t wanted_ns,
                        std::int64_t& rest_ns) noexcept TERRACUT_NONBLOCKING {
  const std::int64_t share_ns = std::clamp<std::int64_t>(wanted_ns, 0, rest_ns);
  rest_ns -= share_ns;
  return share_ns;
}

FrameMissCause largest_share(const FrameRecord& frame,
                             std::int64_t latency_ns) noexcept TERRACUT_NONBLOCKING {
  std::int64_t rest_ns = latency_ns;
  const std::int64_t closed_ns =
      frame.closing_packet_ns == 0 ? frame.info.last_packet_ns : frame.closing_packet_ns;
  std::array<std::int64_t, kMissCauses> share_ns{};
  const auto share_of = [&](FrameMissCause cause) -> std::int64_t& {
    return share_ns[static_cast<std::size_t>(cause)];
  };
  share_of(FrameMissCause::kLateInput) = take_share(closed_ns - frame.info.last_packet_ns, rest_ns);
  share_of(FrameMissCause::kStolenTime) = take_share(frame.steal_ns, rest_ns);
  share_of(FrameMissCause::kWaitingForCore) =
      take_share(frame.run_queue_wait_ns - std::max<std::int64_t>(frame.steal_ns, 0), rest_ns);
  share_of(FrameMissCause::kOwnWork) = rest_ns;
  // Of equal shares max_element() finds the first, and the enumeration begins with our own work.
  const auto largest = std::max_element(share_ns.begin(), share_ns.end());
  return static_cast<FrameMissCause>(largest - share_ns.begin());
}

}  // namespace

DeadlineMonitor::DeadlineMonitor(const Config& config, memory::FixedMemory& memory)
    : snapshot_(
          std::construct_at(memory.take<MonitorSnapshot>("deadline monitor: figures", 1).data())),
      kept_(memory.take<FrameRecord>("deadline monitor: newest frames",
                                     std::max<std::size_t>(config.kept_frames, 2))) {
  snapshot_->deadline_ns = config.deadline_ns;
  const auto names =
      config.stage_names.first(std::min(config.stage_names.size(), MonitorSnapshot::kMaxStages));
  snapshot_->stage_count = static_cast<std::uint32_t>(names.size());
  std::copy(names.begin(), names.end(), snapshot_->stage_names.begin());
}

void DeadlineMonitor::judge(FrameRecord& frame) noexcept TERRACUT_NONBLOCKING {
  MonitorSnapshot& figures = *snapshot_;
  ++figures.frames;
  figures.returns += frame.info.returns;
  figures.returns_below += frame.segmentation.below;
  if (frame.level < Level::kCount) ++figures.levels[static_cast<std::size_t>(frame.level)];

  judge_latency(frame);
  if (frame.missed) {
    ++figures.misses[static_cast<std::size_t>(frame.cause)];
    ++figures.consecutive_misses;
    figures.longest_run_of_misses =
        std::max(figures.longest_run_of_misses, figures.consecutive_misses);
  } else {
    figures.consecutive_misses = 0;
  }
  record_firing_to_label(frame);
  record_motion(frame);
  record_costs(frame);
  keep(frame);
  figures.frames_per_s = frames_per_s();
}

void DeadlineMonitor::judge_latency(FrameRecord& frame) noexcept TERRACUT_NONBLOCKING {
  MonitorSnapshot& figures = *snapshot_;
  const bool skipped = frame.level == Level::kSkipped;
  frame.missed = skipped;
  frame.cause = FrameMissCause::kOwnWork;
  // No latency can be told: a clock was set back between packet and labels, or the packet has no
  // stamp.
  if (frame.info.last_packet_ns <= 0 || frame.labels_ns < frame.info.last_packet_ns) {
    ++figures.unjudged;
    return;
  }
  const std::int64_t latency_ns = frame.labels_ns - frame.info.last_packet_ns;
  frame.missed = skipped || latency_ns > figures.deadline_ns;
  if (frame.missed) frame.cause = largest_share(frame, latency_ns);
  if (skipped) return;  // without labels there is no latency; 0 would look like a fast frame
  figures.latency.record(latency_ns);
  if (frame.handed_over_ns > 0) figures.wall.record(frame.labels_ns - frame.handed_over_ns);
}

void DeadlineMonitor::record_firing_to_label(const FrameRecord& frame) noexcept
    TERRACUT_NONBLOCKING {
  MonitorSnapshot& figures = *snapshot_;
  for (const std::int64_t longest_ns : frame.firing_to_label.longest_ns) {
    if (longest_ns <= 0) continue;
    figures.firing_to_label.record(longest_ns);
    if (longest_ns > figures.deadline_ns) ++figures.late_sectors;
  }
  figures.firing_to_label_sum_ns += frame.firing_to_label.sum_ns;
  figures.firing_to_label_count += frame.firing_to_label.count;
}

void DeadlineMonitor::record_motion(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING {
  MotionFigures& motion = snapshot_->motion;
  const frame::DeskewInfo& deskew = frame.info.deskew;
  if (deskew.state == frame::DeskewState::kOff) return;
  const std::int64_t after_frame_ns = deskew.newest_motion_ns;
  motion.newest_sample_after_frame_ns = after_frame_ns;
  if (deskew.state == frame::DeskewState::kNoEgoMotion) {
    ++motion.no_ego_motion;
    return;
  }
  const bool first = motion.deskewed++ == 0;
  motion.least_sample_after_frame_ns =
      first ? after_frame_ns : std::min(motion.least_sample_after_frame_ns, after_frame_ns);
  motion.most_sample_after_frame_ns =
      first ? after_frame_ns : std::max(motion.most_sample_after_frame_ns, after_frame_ns);
  motion.sum_sample_after_frame_ns += static_cast<double>(after_frame_ns);
}

void DeadlineMonitor::record_costs(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING {
  MonitorSnapshot& figures = *snapshot_;
  figures.decode_cpu.record(frame.decode_cpu_ns);
  if (frame.level == Level::kSkipped) return;
  figures.total_cpu.record(frame.decode_cpu_ns + frame.segment_cpu_ns);
  figures.segment_cpu.record(frame.segment_cpu_ns);
  for (std::size_t i = 0; i < figures.stages(); ++i) {
    // A frame that skipped this stage is left out; otherwise the stage would look cheap.
    if (frame.stages.stage_ns[i] > 0) figures.stage_cpu[i].record(frame.stages.stage_ns[i]);
  }
}

void DeadlineMonitor::keep(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING {
  kept_[next_] = frame;
  next_ = next_ + 1 == kept_.size() ? 0 : next_ + 1;
  count_ = std::min(count_ + 1, kept_.size());
}

/// Returns the frame judged `age` frames before the newest one; age < count_.
const FrameRecord& DeadlineMonitor::kept_before(std::size_t age) const noexcept
    TERRACUT_NONBLOCKING {
  return kept_[(next_ + kept_.size() - 1 - age) % kept_.size()];
}

double DeadlineMonitor::frames_per_s() const noexcept TERRACUT_NONBLOCKING {
  const auto newest_ns = static_cast<std::uint64_t>(newest().info.last_packet_ns);
  std::int64_t least_ns = 0, most_ns = 0;  // relative to the newest; negative for skipped frames
  std::size_t age = 0;
  while (age < std::min(count_ - 1, kRateFrames)) {
    const auto stamp_ns = static_cast<std::uint64_t>(kept_before(age + 1).info.last_packet_ns);
    const auto before_ns = static_cast<std::int64_t>(newest_ns - stamp_ns);  // wraps for odd stamps
    if (before_ns < -kRateWindow_ns || before_ns > kRateWindow_ns) break;
    least_ns = std::min(least_ns, before_ns);
    most_ns = std::max(most_ns, before_ns);
    ++age;
  }
  const std::int64_t span_ns = most_ns - least_ns;
  return span_ns == 0 ? 0.0 : static_cast<double>(age) * kSecond_ns / static_cast<double>(span_ns);
}

void DeadlineMonitor::look_at_rate(std::int64_t now_ns) noexcept TERRACUT_NONBLOCKING {
  const bool stopped = now_ns - newest().info.last_packet_ns > kStopped_ns;
  if (stopped) snapshot_->frames_per_s = 0;
}

std::size_t DeadlineMonitor::copy_newest(std::span<FrameRecord> into) const noexcept
    TERRACUT_NONBLOCKING {
  const std::size_t copied = std::min(into.size(), count_);
  for (std::size_t i = 0; i < copied; ++i) into[i] = kept_before(copied - 1 - i);
  return copied;
}

}  // namespace terracut::status
