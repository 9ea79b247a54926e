// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/health/health_frames.hpp"

#include <algorithm>

#include "pipeline/status/loss_causes.hpp"

namespace terracut::health {
namespace {

constexpr std::int64_t kLatencyStep_ns = 10'000;
constexpr std::int64_t kMostLatency = 0xFFFE;
constexpr std::uint64_t kNoLatency = 0xFFFF;
constexpr std::uint64_t kNoCause = 7;
constexpr std::uint64_t kMostReturns = (1U << 18) - 1;
constexpr float kMostVisible_m = 254;
constexpr std::uint64_t kNothingVisible = 255;

/// A run of bits in a frame, counted from the lowest, like "start|count@1+" in a DBC file.
struct Bits {
  unsigned start, count;
};

/// Writes the lowest bits of `value` into bits that are still 0.
void put(can::CanFrame& frame, Bits bits, std::uint64_t value) noexcept {
  for (unsigned i = 0; i < bits.count; ++i) {
    const unsigned at = bits.start + i;
    const unsigned bit = static_cast<unsigned>(value >> i & 1) << at % 8;
    frame.data[at / 8] = static_cast<std::uint8_t>(frame.data[at / 8] | bit);
  }
}

can::CanFrame empty_frame(can::CanId id) noexcept {
  can::CanFrame frame;
  frame.id = id;
  frame.length = can::CanFrame::kMostClassicBytes;
  return frame;
}

std::uint64_t latency_of(const HealthReport& report) noexcept {
  if (report.latency_ns < 0 || report.level == status::Level::kSkipped) return kNoLatency;
  return static_cast<std::uint64_t>(std::min(report.latency_ns / kLatencyStep_ns, kMostLatency));
}

/// Returns 0 while the view is being learnt, else 1 and more: clear, reduced, blocked.
std::uint64_t view_state_of(const visibility::SightFigures& sight) noexcept {
  return sight.has_learnt == 0 ? 0 : static_cast<std::uint64_t>(sight.worst().state) + 1;
}

}  // namespace

HealthReport health_report_of(const status::MonitorSnapshot& figures,
                              const status::FrameRecord& newest) noexcept {
  HealthReport report;
  report.frame_number = newest.info.number;
  report.returns = newest.info.returns;
  report.level = newest.level;
  report.missed = newest.missed;
  report.cause = newest.cause;
  report.ego_motion = newest.info.deskew.state == frame::DeskewState::kDone;
  const bool known =
      newest.info.last_packet_ns > 0 && newest.labels_ns >= newest.info.last_packet_ns;
  if (known) report.latency_ns = newest.labels_ns - newest.info.last_packet_ns;
  report.link = figures.link;
  report.misses = figures.all_misses();
  report.skipped = figures.levels[static_cast<std::size_t>(status::Level::kSkipped)];
  for (const status::NamedCount& loss : figures.losses_in_use()) {
    if (!status::is_of_onlookers(loss.name.view())) report.losses += loss.count;
  }
  return report;
}

std::array<can::CanFrame, 2> health_frames(const HealthReport& report, can::CanId first) noexcept {
  std::array frames{empty_frame(first), empty_frame({first.number + 1, first.extended})};
  can::CanFrame& frame = frames[0];
  put(frame, {0, 16}, report.frame_number);
  put(frame, {16, 3}, static_cast<std::uint64_t>(report.level));
  put(frame, {19, 1}, report.missed ? 1 : 0);
  put(frame, {20, 3}, report.missed ? static_cast<std::uint64_t>(report.cause) : kNoCause);
  put(frame, {23, 1}, report.ego_motion ? 1 : 0);
  put(frame, {24, 16}, latency_of(report));
  put(frame, {40, 18}, std::min<std::uint64_t>(report.returns, kMostReturns));
  put(frame, {58, 2}, static_cast<std::uint64_t>(report.link));
  can::CanFrame& totals = frames[1];
  put(totals, {0, 16}, report.misses);
  put(totals, {16, 16}, report.skipped);
  put(totals, {32, 24}, report.losses);
  put(totals, {56, 8}, report.alive);
  return frames;
}

can::CanFrame sight_frame(const visibility::SightFigures& sight, std::uint32_t alive,
                          can::CanId first) noexcept {
  can::CanFrame frame = empty_frame({first.number + 2, first.extended});
  put(frame, {0, 2}, view_state_of(sight));
  put(frame, {2, 3}, static_cast<std::uint64_t>(sight.worst().cause));
  put(frame, {5, 6}, static_cast<std::uint64_t>(sight.troubled_sectors()));
  for (std::size_t i = 0; i < sight.sectors.size(); ++i) {
    const bool is_troubled = sight.sectors[i].condition.state != visibility::State::kClear;
    put(frame, {12 + static_cast<unsigned>(i), 1}, is_troubled ? 1 : 0);
  }
  const visibility::SightFigures::Of ahead = sight.in(visibility::Direction::kAhead);
  put(frame, {48, 8},
      ahead.with_view == 0 ? kNothingVisible
                           : static_cast<std::uint64_t>(std::min(ahead.visible_m, kMostVisible_m)));
  put(frame, {56, 8}, alive);
  return frame;
}

}  // namespace terracut::health
