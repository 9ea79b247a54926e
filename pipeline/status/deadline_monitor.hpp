// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::status {

/// Judges every frame by its deadline, names the cause of a miss, and keeps the figures.
///
/// A frame's latency runs from the kernel's stamp of its last packet to its last labels. The frame
/// missed its deadline if the latency is longer or if it was skipped. Each return has that
/// deadline, too: sectors in which one missed it are counted (FiringToLabel). The latency is
/// divided into shares in this order, each share at most what is left:
///
///   late_input         last packet -> closing packet: the sensor or the network was late
///   stolen_time        steal_ns
///   waiting_for_core   run_queue_wait_ns beyond steal_ns: the kernel counts a wait during which
///                      the hypervisor was away in both
///   own_work           the rest, explained or not: nothing is excused that was not measured
///
/// The largest share is the cause; of equal shares, the lowest in this list, which is the closer to
/// our own work.
///
/// All memory is fixed and taken in the constructor. One thread at a time; no function allocates,
/// locks, makes a system call or reads a clock.
class DeadlineMonitor {
 public:
  struct Config {
    std::int64_t deadline_ns = 50'000'000;            ///< > 0
    std::span<const std::string_view> stage_names{};  ///< At most MonitorSnapshot::kMaxStages.
    std::size_t kept_frames = 128;                    ///< Number of frames kept for traces, >= 2.
  };

  DeadlineMonitor(const Config& config, memory::FixedMemory& memory);

  /// Sets frame.missed and frame.cause, counts the frame and keeps it.
  void judge(FrameRecord& frame) noexcept TERRACUT_NONBLOCKING;

  /// Sets the rate of frames to 0 if the newest frame is more than a second old at `now_ns`, a time
  /// of day.
  void look_at_rate(std::int64_t now_ns) noexcept TERRACUT_NONBLOCKING;

  /// Returns the frame judged last, or a value without stamps if no frame has been judged.
  [[nodiscard]] const FrameRecord& newest() const noexcept TERRACUT_NONBLOCKING {
    return kept_before(0);
  }
  /// Copies the newest frames judged, oldest first, at most into.size() and kept_frames. Returns
  /// how many were copied.
  std::size_t copy_newest(std::span<FrameRecord> into) const noexcept TERRACUT_NONBLOCKING;

  /// Returns the figures. judge() fills in everything that comes from frames, deadline_ns and the
  /// names of the stages; the caller fills in the other fields (version, sensor, input, link,
  /// losses, threads, times, and those of the CAN bus).
  [[nodiscard]] MonitorSnapshot& snapshot() noexcept { return *snapshot_; }
  [[nodiscard]] const MonitorSnapshot& snapshot() const noexcept { return *snapshot_; }

 private:
  void judge_latency(FrameRecord& frame) noexcept TERRACUT_NONBLOCKING;
  void record_firing_to_label(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING;
  void record_motion(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING;
  void record_costs(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING;
  void keep(const FrameRecord& frame) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] double frames_per_s() const noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] const FrameRecord& kept_before(std::size_t age) const noexcept TERRACUT_NONBLOCKING;

  MonitorSnapshot* snapshot_;
  std::span<FrameRecord> kept_;  ///< Ring buffer.
  std::size_t next_ = 0;         ///< Index in kept_ for the next frame.
  std::size_t count_ = 0;        ///< Number of frames in kept_.
};

}  // namespace terracut::status
