// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware_io/frame/frame_info.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage_times.hpp"

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

/// All that is known of one frame: filled on its way, from the first packet to the last report, by
/// the threads it passes; judged at the end (pipeline/status/deadline_monitor.hpp). Times of day
/// are CLOCK_REALTIME like the kernel's stamps of packets; 0 means "not known". Trivially copyable,
/// no thread contract of its own.
struct FrameRecord {
  frame::FrameInfo info;  ///< What the decoder knows: number, packets' stamps, returns, losses.

  std::int64_t closing_packet_ns = 0;  ///< Of the packet that showed that the frame is over.
  std::int64_t handed_over_ns = 0;     ///< Decoded, and given to the segmenting thread.
  std::int64_t segment_begin_ns = 0;
  std::int64_t labels_ns = 0;  ///< Labels handed out; when it was given up if skipped.

  /// Processor time of the threads that did it.
  std::int64_t decode_cpu_ns = 0;   ///< All packets of the frame.
  stage::StageTimes stages;         ///< By stage.
  std::int64_t ahead_cpu_ns = 0;    ///< Of the stages, while the frame was still arriving.
  std::int64_t segment_cpu_ns = 0;  ///< All stages and what lies between them.

  /// From the last packet to the labels, of the frame's threads.
  std::int64_t run_queue_wait_ns = 0;
  /// Stolen from the machine around that, where the deadline was missed; else 0.
  std::int64_t steal_ns = 0;

  stage::SegmentationReport segmentation;
  Level level = Level::kFull;
  std::uint8_t stages_ahead = 0;  ///< So many of the first stages were over at hand-over.

  bool missed = false;  ///< Set by DeadlineMonitor::judge.
  FrameMissCause cause =
      FrameMissCause::kOwnWork;  ///< Set by judge; means something only if missed.

  /// Processor time of the stages after the last packet of the frame.
  [[nodiscard]] std::int64_t after_frame_cpu_ns() const noexcept {
    return stages.sum_ns() - ahead_cpu_ns;
  }
};

}  // namespace terracut::status
