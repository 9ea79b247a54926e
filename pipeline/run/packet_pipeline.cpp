// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/packet_pipeline.hpp"

#include <utility>

#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::run {

void PacketPipeline::push(const packet::Datagram& datagram) noexcept {
  if (timing_ == Timing::kPackets || std::exchange(begins_, false)) resume();
  before_push_ns_ = clock_.sum_ns();
  turns_.push(datagram);
}

void PacketPipeline::end_stream() noexcept {
  if (timing_ == Timing::kPackets) resume();
  before_push_ns_ = clock_.sum_ns();
  begins_ = true;
  turns_.end_stream();
}

void PacketPipeline::resume() noexcept {
  resumed_ns_ = measure::thread_cpu_ns();
}

void PacketPipeline::pause() noexcept {
  work_ns_ += measure::thread_cpu_ns() - resumed_ns_;
}

Frame* PacketPipeline::next() noexcept {
  if (std::exchange(frame_.returns, nullptr) != nullptr) resume();
  const frame::Frame* const turn = turns_.next({}, &clock_);
  if (turn != nullptr || timing_ == Timing::kPackets) pause();
  if (turn == nullptr) return nullptr;
  frame_ = {.returns = turn->returns,
            .motions = turn->motions,
            .image = points_ ? &points_->make(*turn->returns, turn->motions) : nullptr,
            .as_measured = nullptr,
            .record = {}};
  frame_.as_measured =
      as_measured_ && !turn->motions.empty() ? &as_measured_->make(*turn->returns) : frame_.image;
  status::FrameRecord& record = frame_.record;
  record.info = turn->info;
  record.segmentation = turns_.report();
  record.stages = clock_.take();
  record.segment_cpu_ns = record.stages.sum_ns();
  record.ahead_cpu_ns = std::exchange(before_push_ns_, 0);
  record.decode_cpu_ns = std::exchange(work_ns_, 0) - record.segment_cpu_ns;
  return &frame_;
}

}  // namespace terracut::run
