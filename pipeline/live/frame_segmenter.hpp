// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "pipeline/live/degradation_policy.hpp"
#include "pipeline/live/frame_exchange.hpp"
#include "pipeline/live/frame_pool.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/latest_near_ground.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// The segmenting half of a live run: takes the newest frame and hands its labels on before the
/// deadline. One thread with a deadline, which calls work_round() repeatedly.
///
/// `Clock` is like measure::SystemClock, `Wait` like measure::RunQueueWait.
template <class Clock, class Wait>
class FrameSegmenter {
 public:
  /// Where results go. Everything pointed to must outlive this object; the slots and `near_ground`
  /// may be null.
  struct Outlets {
    FrameRecords* records;
    FramePool<frame::Label>* labels;
    FramePool<points::LabelledPoint>* points;
    const threads::WakeEvent* points_ready;
    LatestNearGround* near_ground = nullptr;
  };

  /// `deadline_ns` is the time from a frame's last packet to its labels.
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

  /// Segments the newest frame. Returns false if there is no frame that it has not segmented yet.
  bool work_round() noexcept TERRACUT_NONBLOCKING {
    run::Frame* frame = frames_.take_if_new();
    if (frame == nullptr) return false;
    segment(*frame);
    const std::int64_t waited_ns = wait_.read_ns();
    frame->record.run_queue_wait_ns += waited_ns - std::exchange(waited_before_ns_, waited_ns);
    to_.records->pass_on(frame->record);
    return true;
  }

 private:
  void segment(run::Frame& frame) noexcept {
    status::FrameRecord& record = frame.record;
    record.segment_begin_ns = clock_.realtime_ns();
    if (!degradation_.begin(record.info.last_packet_ns)) {
      record.level = status::Level::kSkipped;
      record.labels_ns = clock_.realtime_ns();
      return;
    }
    const std::int64_t begun_cpu_ns = clock_.thread_cpu_ns();
    stage::CellPlanes& planes = pipeline_.planes_of(*frame.returns);
    if (record.stages_ahead == 0)
      pipeline_.late_coarse.finish(*frame.returns, planes, &stage_clock_);
    record.segmentation =
        pipeline_.fine.refine(*frame.returns, planes, degradation_.budget(), &stage_clock_);
    record.level = degradation_.may_hand_on() ? DegradationPolicy::level_of(record.segmentation)
                                              : status::Level::kSkipped;
    record.labels_ns = clock_.realtime_ns();
    const std::int64_t labelled_cpu_ns = clock_.thread_cpu_ns();
    if (record.level != status::Level::kSkipped) hand_on(frame);
    record.labels_ns = clock_.realtime_ns();  // handing on is part of the latency
    const std::int64_t handed_on_cpu_ns = clock_.thread_cpu_ns();
    record.segment_cpu_ns += handed_on_cpu_ns - begun_cpu_ns;
    const stage::StageTimes times = stage_clock_.take();
    degradation_.end(times, record.segmentation, handed_on_cpu_ns - labelled_cpu_ns);
    if (to_.near_ground != nullptr && record.info.number % LatestNearGround::kFramesApart == 0) {
      to_.near_ground->publish([&](ground::NearGround& ground) noexcept {
        pipeline_.fine.take_near_ground(*frame.returns, planes, ground);
      });
    }
    record.stages += times;
  }

  void hand_on(const run::Frame& frame) noexcept {
    const auto labels = pipeline_.fine.labels();
    if (to_.labels != nullptr) {
      to_.labels->pass_on(frame.record, [&](std::span<frame::Label> room) noexcept {
        std::copy(labels.begin(), labels.end(), room.begin());
      });
    }
    if (to_.points != nullptr) {
      to_.points->pass_on(frame.record, [&](std::span<points::LabelledPoint> room) noexcept {
        (void)points::pack_labelled_points(
            *frame.returns, frame.motions, pipeline_.segmenting_points.reader(), labels, room,
            points::FrameTiming::of(frame.record.info, pipeline_.decoder.beam_turns()));
      });
      to_.points_ready->wake();
    }
  }

  LivePipeline& pipeline_;
  FrameExchange& frames_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  run::StageClockOf<Clock> stage_clock_;
  DegradationPolicyOf<Clock> degradation_;
  std::int64_t waited_before_ns_;
};

}  // namespace terracut::live
