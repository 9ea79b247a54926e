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
  kFull,        ///< The whole method, with the optimal min-cut.
  kCutStopped,  ///< The min-cut was stopped at its budget; its best cut.
  kCoarse,      ///< Elevation map and adjacent points only.
  kSkipped,     ///< No labels.
  kCount,
};
inline constexpr std::size_t kLevels = static_cast<std::size_t>(Level::kCount);

/// The cause of a missed deadline: the largest share of the frame's latency over all its threads.
enum class FrameMissCause : std::uint8_t {
  kOwnWork,         ///< Our computing, and anything the other causes do not explain.
  kWaitingForCore,  ///< Ready to run, but the core was given to others.
  kStolenTime,      ///< The hypervisor gave our core to others.
  kLateInput,       ///< The packet that shows the end of the frame was late.
  kCount,
};
inline constexpr std::size_t kMissCauses = static_cast<std::size_t>(FrameMissCause::kCount);

/// Return stable lower_snake_case names, as in reports; "unknown" for anything else.
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

/// All facts about one frame, filled by the threads it passes from its first packet to the last
/// report, and judged at the end (pipeline/status/deadline_monitor.hpp). Times of day are
/// CLOCK_REALTIME like the kernel's packet stamps; 0 means "unknown". Trivially copyable, no thread
/// contract of its own.
struct FrameRecord {
  frame::FrameInfo info;  ///< From the decoder: number, packets' stamps, returns, losses.

  std::int64_t closing_packet_ns = 0;  ///< Of the packet that showed the end of the frame.
  std::int64_t handed_over_ns = 0;     ///< When the decoded frame went to the segmenting thread.
  std::int64_t segment_begin_ns = 0;
  std::int64_t labels_ns = 0;  ///< When labels were handed out; if skipped, when it was given up.

  /// The processor time of the work on it.
  std::int64_t decode_cpu_ns = 0;   ///< All packets of the frame.
  stage::StageTimes stages;         ///< Indexed by stage.
  std::int64_t ahead_cpu_ns = 0;    ///< Of the stages, while the frame was arriving.
  std::int64_t segment_cpu_ns = 0;  ///< Of all stages and the work between them.

  /// Of the frame's threads, from the last packet to the labels.
  std::int64_t run_queue_wait_ns = 0;
  /// Stolen from the machine around that time if the deadline was missed; else 0.
  std::int64_t steal_ns = 0;

  stage::SegmentationReport segmentation;
  Level level = Level::kFull;
  std::uint8_t stages_ahead = 0;  ///< The number of first stages done at hand-over.

  bool missed = false;                              ///< Set by DeadlineMonitor::judge.
  FrameMissCause cause = FrameMissCause::kOwnWork;  ///< Set by judge; valid only if missed.

  /// Returns the processor time of the stages after the frame's last packet.
  [[nodiscard]] std::int64_t after_frame_cpu_ns() const noexcept {
    return stages.sum_ns() - ahead_cpu_ns;
  }
};

}  // namespace terracut::status
