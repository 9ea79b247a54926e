// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "pipeline/run/deadline_ladder.hpp"
#include "pipeline/run/frame_exchange.hpp"
#include "pipeline/run/frame_slots.hpp"
#include "pipeline/run/frame_timings.hpp"
#include "pipeline/run/latest_near_ground.hpp"
#include "pipeline/run/live_pipeline.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/stream/labelled_points.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::run {

/// The segmenting half of a live run: the newest turn in, its labels handed on before the deadline.
/// One thread with a deadline, which turn_round() is the work of.
///
/// `Clock`: as measure::SystemClock. `Wait`: as measure::RunQueueWait.
template <class Clock, class Wait>
class FrameSegmenter {
 public:
  /// Where things go; all must outlive this. Slots and `near_ground` may be null.
  struct Outlets {
    FrameTimings* timings;
    FrameSlots<frame::Label>* labels;
    FrameSlots<stream::LabelledPoint>* points;
    const threads::WakeEvent* points_ready;
    LatestNearGround* near_ground = nullptr;
  };

  /// `deadline_ns`: from a turn's last packet to its labels.
  FrameSegmenter(std::int64_t deadline_ns, LivePipeline& pipeline, FrameExchange& turns,
                 const Outlets& outlets, Clock clock, Wait wait) noexcept
      : pipeline_(pipeline),
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
    status::FrameTiming& timing = turn.timing;
    timing.segment_begin_ns = clock_.realtime_ns();
    if (!ladder_.begin(turn.info.last_packet_ns)) {
      timing.rung = status::Rung::kSkipped;
      timing.labels_ns = clock_.realtime_ns();
      return;
    }
    const std::int64_t begun_cpu_ns = clock_.thread_cpu_ns();
    stage::CellPlanes& planes = pipeline_.planes_of(*turn.image);
    if (!turn.has_coarse_stages) pipeline_.late_coarse.finish(*turn.image, planes, &stage_clock_);
    const stage::SegmentationReport report =
        pipeline_.fine.refine(*turn.image, planes, ladder_.budget(), &stage_clock_);
    timing.rung = ladder_.may_hand_on() ? DeadlineLadder::rung_of(report) : status::Rung::kSkipped;
    timing.labels_ns = clock_.realtime_ns();
    const std::int64_t labelled_cpu_ns = clock_.thread_cpu_ns();
    if (timing.rung != status::Rung::kSkipped) hand_on(turn);
    timing.labels_ns = clock_.realtime_ns();  // judged by when they were handed on
    const std::int64_t handed_on_cpu_ns = clock_.thread_cpu_ns();
    timing.segment_cpu_ns += handed_on_cpu_ns - begun_cpu_ns;
    const StageTimes times = stage_clock_.take();
    ladder_.end(times, report, handed_on_cpu_ns - labelled_cpu_ns);
    if (to_.near_ground != nullptr && turn.info.number % LatestNearGround::kFramesApart == 0) {
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
    const auto labels = pipeline_.fine.labels();
    if (to_.labels != nullptr) {
      to_.labels->pass_on(turn.info, turn.timing, [&](std::span<frame::Label> room) noexcept {
        std::copy(labels.begin(), labels.end(), room.begin());
      });
    }
    if (to_.points != nullptr) {
      to_.points->pass_on(turn.info, turn.timing,
                          [&](std::span<stream::LabelledPoint> room) noexcept {
                            (void)stream::pack_labelled_points(*turn.image, labels, room);
                          });
      to_.points_ready->wake();
    }
  }

  LivePipeline& pipeline_;
  FrameExchange& turns_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  StageClockOf<Clock> stage_clock_;
  DeadlineLadderOf<Clock> ladder_;
  std::int64_t waited_before_ns_;
};

}  // namespace terracut::run
