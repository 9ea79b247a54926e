// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware_io/frame/frame_info.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage_times.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::status {

/// How much of the method a frame got before its deadline; the best level is the first.
enum class Level : std::uint8_t {
  kFull,        ///< The whole method, with the optimal min-cut.
  kCutStopped,  ///< The min-cut was stopped at its budget; labels are from its best cut.
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

/// These return stable lower_snake_case names for reports; "unknown" for an invalid value.
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

/// How long the returns of a frame waited for their labels, each from the kernel's stamp of its
/// packet. Trivially copyable.
struct FiringToLabel {
  /// A frame is looked at in sectors of ten degrees.
  static constexpr std::size_t kSectors = 36;

  std::array<std::int64_t, kSectors> longest_ns{};  ///< By sector; 0: no return, or not known.
  std::int64_t sum_ns = 0;                          ///< Of all waits noted.
  std::uint32_t count = 0;                          ///< Number of waits noted.

  /// Notes the wait of some returns at `turns` of a revolution, [0, 1).
  void note(double turns, std::int64_t wait_ns) noexcept TERRACUT_NONBLOCKING {
    const auto sector = static_cast<std::size_t>(turns * static_cast<double>(kSectors));
    std::int64_t& longest = longest_ns[std::min(sector, kSectors - 1)];
    longest = std::max(longest, wait_ns);
    sum_ns += wait_ns;
    ++count;
  }
};

/// All facts about one frame, filled in by the threads that the frame passes from its first packet
/// to the last report, and judged at the end (pipeline/status/deadline_monitor.hpp). Times of day
/// are CLOCK_REALTIME like the kernel's packet stamps; 0 means "unknown". Trivially copyable; only
/// one thread at a time may use it.
struct FrameRecord {
  frame::FrameInfo info;  ///< From the decoder: number, packets' stamps, returns, losses.

  std::int64_t closing_packet_ns = 0;  ///< Stamp of the packet with which its last labels came.
  std::int64_t handed_over_ns = 0;     ///< When work on that packet, or on a cloud, began.
  std::int64_t labels_ns = 0;          ///< When labels were handed out or the frame was skipped.
  FiringToLabel firing_to_label;       ///< Known in a live run.

  /// Processor time of the work on the frame:
  std::int64_t decode_cpu_ns = 0;   ///< Decoding all packets of the frame.
  stage::StageTimes stages;         ///< Indexed by stage.
  std::int64_t ahead_cpu_ns = 0;    ///< Stages done before the closing packet.
  std::int64_t segment_cpu_ns = 0;  ///< All stages and the work between them.

  /// How long the frame's threads waited for a core, from its last packet to the labels.
  std::int64_t run_queue_wait_ns = 0;
  /// Time that the hypervisor took from the machine between last packet and labels; 0 if the
  /// deadline was met.
  std::int64_t steal_ns = 0;

  stage::SegmentationReport segmentation;
  Level level = Level::kFull;

  bool missed = false;                              ///< Set by DeadlineMonitor::judge.
  FrameMissCause cause = FrameMissCause::kOwnWork;  ///< Set by judge; valid only if missed.

  /// Returns the processor time of the stages that ran after the closing packet.
  [[nodiscard]] std::int64_t after_frame_cpu_ns() const noexcept {
    return stages.sum_ns() - ahead_cpu_ns;
  }
};

}  // namespace terracut::status
