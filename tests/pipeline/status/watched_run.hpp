// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "firmware_io/frame/loss_counters.hpp"
#include "pipeline/status/deadline_monitor.hpp"
#include "pipeline/status/loss_causes.hpp"

namespace terracut::status {

/// The figures of an invented live run at 10 Hz: 100 frames, of which number 40 waited for its
/// core, 41 was skipped and 42 got coarse labels in time.
class WatchedRun {
 public:
  static constexpr std::int64_t kMs = 1'000'000;
  static constexpr std::int64_t kStart_ns = 1'700'000'000'000 * kMs;
  static constexpr std::uint32_t kFrames = 100;
  static constexpr std::int64_t kEnd_ns = kStart_ns + kFrames * 100 * kMs;

  WatchedRun() {
    MonitorSnapshot& figures = monitor_->snapshot();
    figures.version = "1.2.3";
    figures.sensor = "HDL-64E, 600.0 rpm, \"strongest\"";
    figures.input = "127.0.0.1:2368";
    figures.started_ns = kStart_ns;
    figures.taken_ns = kEnd_ns;
    figures.link = LinkState::kReceiving;
    for (std::uint32_t number = 0; number < kFrames; ++number) judge(number);
    figures.last_packet_ns = newest().info.last_packet_ns;
    net::DatagramAccount account;
    account.source.received = 34'802;
    account.source.delivered = 34'800;
    account.source.foreign = 2;
    account.let_go = 5;
    account.decoded = 34'782;
    account.losses.rejected[0] = 13;
    account.losses.network_gap_packets = 12;
    account.losses.skipped_frames = 1;
    show_datagrams(account, figures);
    show_losses(causes_of(account.losses), figures);
    figures.thread_count = 2;
    figures.threads[0] = {"receive", "FIFO 80, core 2", 0, 0};
    figures.threads[1] = {"segment", "FIFO 70, core 3", 5, 0};
  }

  [[nodiscard]] MonitorSnapshot& figures() { return monitor_->snapshot(); }
  [[nodiscard]] const FrameRecord& newest() const { return monitor_->newest(); }
  [[nodiscard]] std::vector<FrameRecord> frames() const {
    std::vector<FrameRecord> frames(kFrames);
    frames.resize(monitor_->copy_newest(frames));
    return frames;
  }

  /// As if the sensor were set to a field of view.
  void narrow_view() {
    monitor_->snapshot().blind_from_cdeg = 27'012;
    monitor_->snapshot().blind_to_cdeg = 8'990;
  }

  /// As if all frames except two were deskewed, and health were told.
  void hear_vehicle() {
    MonitorSnapshot& figures = monitor_->snapshot();
    figures.motion.bus = "can0";
    figures.motion.state = MotionState::kKnown;
    figures.motion.samples = 1034;
    figures.motion.last_sample_ns = kEnd_ns;
    figures.motion.deskewed = 98;
    figures.motion.no_ego_motion = 2;
    figures.motion.newest_sample_after_frame_ns = -4 * kMs;
    figures.motion.least_sample_after_frame_ns = -13 * kMs;
    figures.motion.most_sample_after_frame_ns = 2 * kMs;
    figures.motion.sum_sample_after_frame_ns = -98.0 * 5 * kMs;
    figures.motion.faults[figures.motion.fault_count++] = {"kernel_drops", 7};
    figures.motion.faults[figures.motion.fault_count++] = {"bus_off", 0};
    figures.health = {.bus = {"can1"}, .sent = 190, .queue_full = 10, .link_down = 0, .failed = 0};
  }

 private:
  static constexpr std::array<std::string_view, 3> kStages{"elevation_map", "adjacent_points",
                                                           "min_cut"};

  void judge(std::uint32_t number) {
    FrameRecord frame;
    frame.info.number = number;
    frame.info.returns = 100'000;
    frame.info.first_packet_ns = kStart_ns + number * 100 * kMs;
    frame.info.last_packet_ns =
        frame.info.first_packet_ns + 105 * kMs;  // two frames are open at the seam
    frame.closing_packet_ns = frame.info.last_packet_ns;
    frame.handed_over_ns = frame.info.last_packet_ns + 1 * kMs;
    frame.labels_ns = frame.handed_over_ns + 10 * kMs;
    frame.decode_cpu_ns = 4 * kMs;
    frame.stages.stage_ns = {2 * kMs, 1 * kMs, 5 * kMs};
    frame.segment_cpu_ns = 8 * kMs;
    frame.segmentation.cut.persistency_ops = 1000;
    if (number == 40) {
      frame.run_queue_wait_ns = 70 * kMs;
      frame.labels_ns += 70 * kMs;
    } else if (number == 41) {
      frame.level = Level::kSkipped;
      frame.stages = {};
      frame.segment_cpu_ns = 0;
      frame.labels_ns = frame.handed_over_ns;
    } else if (number == 42) {
      frame.level = Level::kCoarse;
      frame.stages.stage_ns[2] = 0;
      frame.segment_cpu_ns = 3 * kMs;
    }
    monitor_->judge(frame);
  }

  memory::FixedMemory memory_;
  std::unique_ptr<DeadlineMonitor> monitor_ = std::make_unique<DeadlineMonitor>(
      DeadlineMonitor::Config{.deadline_ns = 50 * kMs, .stage_names = kStages}, memory_);
};

}  // namespace terracut::status
