// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "pipeline/status/bus_figures.hpp"
#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/mount_figures.hpp"
#include "pipeline/status/named_count.hpp"
#include "pipeline/visibility/sight_figures.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "rt/memory/fixed_text.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::status {

/// The state of the sensor's link.
enum class LinkState : std::uint8_t {
  kWaiting,        ///< No packet has come yet.
  kReceiving,      ///< Packets are coming.
  kSilent,         ///< Packets came, but not recently.
  kInterfaceGone,  ///< The network interface was removed or is down.
  kCount,
};

/// Returns a stable lower_snake_case name, as in reports; "unknown" for anything else.
[[nodiscard]] constexpr std::string_view to_string(LinkState state) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(LinkState::kCount)> kNames{
      "waiting", "receiving", "silent", "interface_gone"};
  return state < LinkState::kCount ? kNames[static_cast<std::size_t>(state)] : "unknown";
}

/// A real-time thread and how the system runs it.
struct ThreadStatus {
  memory::FixedText<16> name;
  memory::FixedText<32> scheduling;                  ///< What was granted: "FIFO 80, core 2".
  std::uint64_t minor_faults = 0, major_faults = 0;  ///< Page faults since the thread's start-up.
};

/// All that can be known of a running process from outside, in one piece without pointers. It is
/// copied whole into the status page, and all displays (terracut top, /metrics, the final summary)
/// read nothing else. Counts come with their names, so that another build can read them. About 385
/// KiB, mostly histogram buckets.
///
/// A plain value. If it comes from another process it may have any bytes; the accessors below and
/// to_string are safe even then.
struct MonitorSnapshot {
  /// The version of the layout; increase it with every change.
  static constexpr std::uint32_t kLayout = 13;
  static constexpr std::size_t kMaxLosses = 64;
  static constexpr std::size_t kMaxOutcomes = 24;
  static constexpr std::size_t kMaxThreads = 4;
  static constexpr std::size_t kMaxStages = stage::kStages;

  memory::FixedText<24> version;  ///< The program's version.
  memory::FixedText<96> sensor;   ///< Model, spin rate, return mode.
  memory::FixedText<64> input;    ///< Where packets come from: "0.0.0.0:2368".
  std::int64_t started_ns = 0;    ///< CLOCK_REALTIME, as are all times of day here.
  std::int64_t taken_ns = 0;      ///< When this snapshot was taken.
  std::int64_t deadline_ns = 0;
  std::uint8_t interrupted = 0;  ///< 1: the run ended before the requested time.

  LinkState link = LinkState::kWaiting;
  std::uint64_t silences = 0;       ///< How often no packet came for a second or longer.
  std::int64_t silent_ns = 0;       ///< Duration of all silences.
  std::uint8_t head_stands = 0;     ///< 1: packets come, but the sensor's head does not rotate.
  std::uint64_t packets = 0;        ///< Datagrams received and accepted.
  std::int64_t last_packet_ns = 0;  ///< Kernel's stamp of the newest packet.
  /// Azimuths of the head between which the sensor sends nothing, [0, 36000), perhaps across 0;
  /// equal if no such sector is known.
  std::int32_t blind_from_cdeg = 0, blind_to_cdeg = 0;

  std::uint64_t frames = 0;         ///< Judged frames of any level.
  std::uint64_t returns = 0;        ///< Returns in these frames.
  std::uint64_t returns_below = 0;  ///< Those far below the ground (SegmentationReport::below).
  std::uint64_t unjudged = 0;       ///< Frames whose stamps give no latency.
  double frames_per_s = 0;          ///< Over the last few seconds of packet stamps; 0: stopped.
  std::array<std::uint64_t, kLevels> levels{};
  std::array<std::uint64_t, kMissCauses> misses{};  ///< Misses of the deadline, by cause.
  std::uint64_t consecutive_misses = 0;             ///< Misses in a row up to the newest frame.
  std::uint64_t longest_run_of_misses = 0;

  MountFigures mount;
  MotionFigures motion;
  HealthFigures health;
  visibility::SightFigures sight;

  /// Datagrams that came or were dropped before labelling began; they are not among `packets` or
  /// `received`.
  std::uint64_t before_labelling = 0;
  std::uint64_t received = 0;       ///< Datagrams from the kernel: `in_doubt` and all `outcomes`.
  std::uint64_t in_doubt = 0;       ///< Received, but not yet known to belong to the stream.
  std::uint32_t outcome_count = 0;  ///< The number of `outcomes` in use.
  std::array<NamedCount, kMaxOutcomes> outcomes{};

  std::uint32_t loss_count = 0;  ///< The number of `losses` in use.
  std::array<NamedCount, kMaxLosses> losses{};
  std::uint32_t thread_count = 0;
  std::array<ThreadStatus, kMaxThreads> threads{};

  std::uint64_t late_sectors = 0;  ///< Sectors of frames of which a label came after its deadline.
  std::int64_t firing_to_label_sum_ns = 0;  ///< Of the waits noted.
  std::uint64_t firing_to_label_count = 0;
  /// Wall time from a return's packet to its label: the longest in each sector of each frame.
  measure::LogLinearHistogram firing_to_label;
  /// Wall time from the packet of an object's last return to the object, where it was handed out
  /// before its frame.
  measure::LogLinearHistogram last_return_to_object;
  measure::LogLinearHistogram latency;      ///< Wall time from the last packet to the labels.
  measure::LogLinearHistogram wall;         ///< Wall time from the hand-over to the labels.
  measure::LogLinearHistogram total_cpu;    ///< Processor time, decoding and segmenting.
  measure::LogLinearHistogram decode_cpu;   ///< Processor time of decoding.
  measure::LogLinearHistogram segment_cpu;  ///< Processor time of segmenting.
  std::uint32_t stage_count = 0;
  std::array<memory::FixedText<24>, kMaxStages> stage_names{};
  std::array<measure::LogLinearHistogram, kMaxStages> stage_cpu{};

  [[nodiscard]] std::size_t stages() const noexcept TERRACUT_NONBLOCKING {
    return std::min<std::size_t>(stage_count, stage_names.size());
  }
  [[nodiscard]] std::span<const NamedCount> losses_in_use() const noexcept {
    return std::span(losses).first(std::min<std::size_t>(loss_count, losses.size()));
  }
  /// Returns what happened to the datagrams; each datagram is in one of these counts.
  [[nodiscard]] std::span<const NamedCount> outcomes_in_use() const noexcept {
    return std::span(outcomes).first(std::min<std::size_t>(outcome_count, outcomes.size()));
  }
  [[nodiscard]] std::span<const ThreadStatus> threads_in_use() const noexcept {
    return std::span(threads).first(std::min<std::size_t>(thread_count, threads.size()));
  }
  [[nodiscard]] std::uint64_t all_misses() const noexcept {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : misses) sum += count;
    return sum;
  }
};
static_assert(std::is_trivially_copyable_v<MonitorSnapshot>);

}  // namespace terracut::status
