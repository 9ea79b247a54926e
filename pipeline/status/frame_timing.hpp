// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace terracut::status {

/// How much of the method a frame got before its deadline, best first.
enum class Level : std::uint8_t {
  kFull,        ///< The whole method, the min-cut to its optimum.
  kCutStopped,  ///< The min-cut stopped at its budget: the best cut so far.
  kCoarse,      ///< Elevation map and adjacent points only.
  kSkipped,     ///< No labels at all.
  kCount,
};
inline constexpr std::size_t kLevels = static_cast<std::size_t>(Level::kCount);

/// Whose fault a missed deadline was: what the largest share of the frame's latency went to, over
/// all threads it passed.
enum class FrameMissCause : std::uint8_t {
  kOwnWork,         ///< Our computing, and everything that nothing below explains.
  kWaitingForCore,  ///< Ready to run, but the core was given to others.
  kStolenTime,      ///< The hypervisor ran something else on our core.
  kLateInput,       ///< The packet that shows that the frame is over came late.
  kCount,
};
inline constexpr std::size_t kMissCauses = static_cast<std::size_t>(FrameMissCause::kCount);

/// Whether a frame was freed of the vehicle's motion.
enum class FrameMotion : std::uint8_t {
  kNotAsked,
  kDeskewed,
  kNoEgoMotion,  ///< Asked for but not known: the frame is as the sensor saw it.
  kCount,
};

/// Stable lower_snake_case names, as in reports; "unknown" for anything else.
[[nodiscard]] constexpr std::string_view to_string(Level level) noexcept {
  constexpr std::array<std::string_view, kLevels> kNames{"full", "cut_stopped", "coarse",
                                                         "skipped"};
  return level < Level::kCount ? kNames[static_cast<std::size_t>(level)] : "unknown";
}
[[nodiscard]] constexpr std::string_view to_string(FrameMissCause cause) noexcept {
  constexpr std::array<std::string_view, kMissCauses> kNames{"own_work", "waiting_for_core",
                                                             "stolen_time", "late_input"};
  return cause < FrameMissCause::kCount ? kNames[static_cast<std::size_t>(cause)] : "unknown";
}

[[nodiscard]] constexpr std::string_view to_string(FrameMotion motion) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(FrameMotion::kCount)> kNames{
      "not_asked", "deskewed", "no_ego_motion"};
  return motion < FrameMotion::kCount ? kNames[static_cast<std::size_t>(motion)] : "unknown";
}

/// When one frame was where, and what it cost: filled on its way by the threads it passes, judged
/// at the end (pipeline/status/deadline_monitor.hpp). Times of day are CLOCK_REALTIME like the
/// kernel's stamps of packets; 0 means "not known". Trivially copyable, no thread contract of its
/// own.
struct FrameTiming {
  static constexpr std::size_t kMaxStages = 8;

  std::uint32_t number = 0;
  std::uint32_t returns = 0;

  std::int64_t first_packet_ns = 0;    ///< Kernel's stamp of the frame's first packet.
  std::int64_t last_packet_ns = 0;     ///< Kernel's stamp of the frame's last packet.
  std::int64_t closing_packet_ns = 0;  ///< Of the packet that showed that the frame is over.
  std::int64_t handed_over_ns = 0;     ///< Decoded, and given to the segmenting thread.
  std::int64_t segment_begin_ns = 0;
  std::int64_t labels_ns = 0;  ///< Labels handed out; when it was given up if skipped.

  /// Processor time of the threads that did it.
  std::int64_t decode_cpu_ns = 0;  ///< All packets of the frame.
  std::array<std::int64_t, kMaxStages> stage_cpu_ns{};
  std::int64_t segment_cpu_ns = 0;  ///< All stages and what lies between them.

  /// From the last packet to the labels, of the frame's threads.
  std::int64_t run_queue_wait_ns = 0;
  /// Stolen from the machine around that, where the deadline was missed; else 0.
  std::int64_t steal_ns = 0;

  std::uint64_t cut_operations = 0;
  Level level = Level::kFull;
  std::uint8_t stages_ahead = 0;  ///< So many of the first stages were over at hand-over.

  FrameMotion motion = FrameMotion::kNotAsked;
  /// Stamp of the vehicle's newest motion known at hand-over, less the instant of the frame's last
  /// firing; 0 without any.
  std::int64_t newest_motion_ns = 0;

  bool missed = false;  ///< Set by DeadlineMonitor::judge.
  FrameMissCause cause =
      FrameMissCause::kOwnWork;  ///< Set by judge; means something only if missed.
};

}  // namespace terracut::status
