// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "pipeline/run/degradation_policy.hpp"
#include "pipeline/run/frame_exchange.hpp"
#include "pipeline/run/frame_pool.hpp"
#include "pipeline/run/frame_timings.hpp"
#include "pipeline/run/latest_near_ground.hpp"
#include "pipeline/run/live_pipeline.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/stream/labelled_points.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::run {

/// The segmenting half of a live run: the newest frame in, its labels handed on before the
/// deadline. One thread with a deadline, which calls work_round() again and again.
///
/// `Clock`: as measure::SystemClock. `Wait`: as measure::RunQueueWait.
template <class Clock, class Wait>
class FrameSegmenter {
 public:
  /// Where things go; all must outlive this. Slots and `near_ground` may be null.
  struct Outlets {
    FrameTimings* timings;
    FramePool<frame::Label>* labels;
    FramePool<stream::LabelledPoint>* points;
    const threads::WakeEvent* points_ready;
    LatestNearGround* near_ground = nullptr;
  };

  /// `deadline_ns`: from a frame's last packet to its labels.
  FrameSegmenter(std::int64_t deadline_ns, LivePipeline& pipeline, FrameExchange& frames,
                 const Outlets& outlets, Clock clock, Wait wait) noexcept
      : pipeline_(pipeline),
        frames_(frames),
        to_(outlets),
        clock_(clock),
        wait_(std::move(wait)),
        stage_clock_(clock),
        degradation_(deadline_ns, clock),
        waited_before_ns_(wait_.read_ns()) {}

  /// Segments the newest frame; false where there is none that it has not had.
  bool work_round() noexcept TERRACUT_NONBLOCKING {
    FrameExchange::Frame* frame = frames_.take_if_new();
    if (frame == nullptr) return false;
    segment(*frame);
    const std::int64_t waited_ns = wait_.read_ns();
    frame->timing.run_queue_wait_ns += waited_ns - std::exchange(waited_before_ns_, waited_ns);
    to_.timings->pass_on(frame->timing);
    return true;
  }

 private:
  void segment(FrameExchange::Frame& frame) noexcept {
    status::FrameTiming& timing = frame.timing;
    timing.segment_begin_ns = clock_.realtime_ns();
    if (!degradation_.begin(frame.info.last_packet_ns)) {
      timing.level = status::Level::kSkipped;
      timing.labels_ns = clock_.realtime_ns();
      return;
    }
    const std::int64_t begun_cpu_ns = clock_.thread_cpu_ns();
    stage::CellPlanes& planes = pipeline_.planes_of(*frame.image);
    if (!frame.has_coarse_stages) pipeline_.late_coarse.finish(*frame.image, planes, &stage_clock_);
    const stage::SegmentationReport report =
        pipeline_.fine.refine(*frame.image, planes, degradation_.budget(), &stage_clock_);
    timing.level =
        degradation_.may_hand_on() ? DegradationPolicy::level_of(report) : status::Level::kSkipped;
    timing.labels_ns = clock_.realtime_ns();
    const std::int64_t labelled_cpu_ns = clock_.thread_cpu_ns();
    if (timing.level != status::Level::kSkipped) hand_on(frame);
    timing.labels_ns = clock_.realtime_ns();  // judged by when they were handed on
    const std::int64_t handed_on_cpu_ns = clock_.thread_cpu_ns();
    timing.segment_cpu_ns += handed_on_cpu_ns - begun_cpu_ns;
    const StageTimes times = stage_clock_.take();
    degradation_.end(times, report, handed_on_cpu_ns - labelled_cpu_ns);
    if (to_.near_ground != nullptr && frame.info.number % LatestNearGround::kFramesApart == 0) {
      to_.near_ground->take(*frame.image);
    }
    for (std::size_t i = 0; i < times.stage_ns.size(); ++i) {
      timing.stage_cpu_ns[i] += times.stage_ns[i];
    }
    timing.cut_operations =
        static_cast<std::uint64_t>(report.cut.persistency_ops + report.cut.greedy_push_ops +
                                   report.cut.boykov_kolmogorov_ops + report.cut.push_relabel_ops);
  }

  void hand_on(const FrameExchange::Frame& frame) noexcept {
    const auto labels = pipeline_.fine.labels();
    if (to_.labels != nullptr) {
      to_.labels->pass_on(frame.info, frame.timing, [&](std::span<frame::Label> room) noexcept {
        std::copy(labels.begin(), labels.end(), room.begin());
      });
    }
    if (to_.points != nullptr) {
      to_.points->pass_on(frame.info, frame.timing,
                          [&](std::span<stream::LabelledPoint> room) noexcept {
                            (void)stream::pack_labelled_points(*frame.image, labels, room);
                          });
      to_.points_ready->wake();
    }
  }

  LivePipeline& pipeline_;
  FrameExchange& frames_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  StageClockOf<Clock> stage_clock_;
  DegradationPolicyOf<Clock> degradation_;
  std::int64_t waited_before_ns_;
};

}  // namespace terracut::run
