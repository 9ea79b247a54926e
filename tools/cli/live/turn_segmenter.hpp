// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "deadline_ladder.hpp"
#include "firmware_io/live/wake_event.hpp"
#include "firmware_io/sinks/labelled_points.hpp"
#include "frame_exchange.hpp"
#include "frame_slots.hpp"
#include "frame_timings.hpp"
#include "latest_near_ground.hpp"
#include "live_chain.hpp"
#include "rt/nonblocking.hpp"
#include "tools/cli/mount_watch.hpp"
#include "tools/cli/stage_clock.hpp"

namespace terracut::cli {

/// The segmenting half of a live run: the newest turn in, its labels handed on before the deadline.
/// One thread with a deadline, which turn_round() is the work of.
///
/// `Clock`: as rt::SystemClock. `Wait`: as rt::RunQueueWait.
template <class Clock, class Wait>
class TurnSegmenter {
 public:
  /// Where things go; all must outlive this. Slots and `near_ground` may be null.
  struct Outlets {
    FrameTimings* timings;
    FrameSlots<pipeline::Label>* labels;
    FrameSlots<firmware_io::LabelledPoint>* points;
    const firmware_io::WakeEvent* points_ready;
    LatestNearGround* near_ground = nullptr;
  };

  /// `deadline_ns`: from a turn's last packet to its labels.
  TurnSegmenter(std::int64_t deadline_ns, LiveChain& chain, FrameExchange& turns,
                const Outlets& outlets, Clock clock, Wait wait) noexcept
      : chain_(chain),
        turns_(turns),
        to_(outlets),
        clock_(clock),
        wait_(std::move(wait)),
        stage_clock_(clock),
        ladder_(deadline_ns, clock),
        waited_before_ns_(wait_.read_ns()) {}

  /// Segments the newest turn; false where there is none that it has not had.
  bool turn_round() noexcept TERRACUT_NONBLOCKING {
    FrameExchange::Turn* turn = turns_.take_if_new();
    if (turn == nullptr) return false;
    segment(*turn);
    const std::int64_t waited_ns = wait_.read_ns();
    turn->timing.run_queue_wait_ns += waited_ns - std::exchange(waited_before_ns_, waited_ns);
    to_.timings->pass_on(turn->timing);
    return true;
  }

 private:
  void segment(FrameExchange::Turn& turn) noexcept {
    rt::FrameTiming& timing = turn.timing;
    timing.segment_begin_ns = clock_.realtime_ns();
    if (!ladder_.begin(turn.info.last_packet_ns)) {
      timing.rung = rt::Rung::kSkipped;
      timing.labels_ns = clock_.realtime_ns();
      return;
    }
    const std::int64_t begun_cpu_ns = clock_.thread_cpu_ns();
    pipeline::CellPlanes& planes = chain_.planes_of(*turn.image);
    if (!turn.has_coarse_stages) chain_.late_coarse.finish(*turn.image, planes, &stage_clock_);
    const pipeline::SegmentationReport report =
        chain_.fine.refine(*turn.image, planes, ladder_.budget(), &stage_clock_);
    timing.rung = ladder_.may_hand_on() ? DeadlineLadder::rung_of(report) : rt::Rung::kSkipped;
    timing.labels_ns = clock_.realtime_ns();
    const std::int64_t labelled_cpu_ns = clock_.thread_cpu_ns();
    if (timing.rung != rt::Rung::kSkipped) hand_on(turn);
    timing.labels_ns = clock_.realtime_ns();  // judged by when they were handed on
    const std::int64_t handed_on_cpu_ns = clock_.thread_cpu_ns();
    timing.segment_cpu_ns += handed_on_cpu_ns - begun_cpu_ns;
    const StageTimes times = stage_clock_.take();
    ladder_.end(times, report, handed_on_cpu_ns - labelled_cpu_ns);
    if (to_.near_ground != nullptr && turn.info.number % MountWatch::kTurnsApart == 0) {
      to_.near_ground->take(*turn.image);
    }
    for (std::size_t i = 0; i < times.stage_ns.size(); ++i) {
      timing.stage_cpu_ns[i] += times.stage_ns[i];
    }
    timing.cut_operations =
        static_cast<std::uint64_t>(report.cut.persistency_ops + report.cut.greedy_push_ops +
                                   report.cut.boykov_kolmogorov_ops + report.cut.push_relabel_ops);
  }

  void hand_on(const FrameExchange::Turn& turn) noexcept {
    const auto labels = chain_.fine.labels();
    if (to_.labels != nullptr) {
      to_.labels->pass_on(turn.info, turn.timing, [&](std::span<pipeline::Label> room) noexcept {
        std::copy(labels.begin(), labels.end(), room.begin());
      });
    }
    if (to_.points != nullptr) {
      to_.points->pass_on(turn.info, turn.timing,
                          [&](std::span<firmware_io::LabelledPoint> room) noexcept {
                            (void)firmware_io::pack_labelled_points(*turn.image, labels, room);
                          });
      to_.points_ready->wake();
    }
  }

  LiveChain& chain_;
  FrameExchange& turns_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  StageClockOf<Clock> stage_clock_;
  DeadlineLadderOf<Clock> ladder_;
  std::int64_t waited_before_ns_;
};

}  // namespace terracut::cli
