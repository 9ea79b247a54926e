// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/packet_pipeline.hpp"

#include <utility>

#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::run {

void PacketPipeline::push(const packet::Datagram& datagram) noexcept {
  if (timing_ == Timing::kPackets || std::exchange(begins_, false)) resume();
  decoder_.push(datagram);
}

void PacketPipeline::end_stream() noexcept {
  if (timing_ == Timing::kPackets) resume();
  begins_ = true;
  decoder_.end_stream();
}

void PacketPipeline::resume() noexcept {
  resumed_ns_ = measure::thread_cpu_ns();
}

void PacketPipeline::pause() noexcept {
  decode_ns_ += measure::thread_cpu_ns() - resumed_ns_;
}

Frame* PacketPipeline::next() noexcept {
  if (frame_.returns != nullptr) {
    frame_.returns = nullptr;
    resume();
  }
  const frame::Frame* frame = decoder_.next();
  const frame::RangeImage* image =
      frame != nullptr && points_ ? &points_->make(*frame->returns, frame->motions) : nullptr;
  if (frame != nullptr || timing_ == Timing::kPackets) pause();
  if (frame == nullptr) {
    const frame::ArrivingFrame arriving = decoder_.arriving();
    if (arriving.returns != nullptr) {
      method_->advance(*arriving.returns, arriving.complete_columns, &clock_);
    }
    return nullptr;
  }
  frame_ = {frame->returns, frame->motions, image, {}};
  status::FrameRecord& record = frame_.record;
  record.info = frame->info;
  record.decode_cpu_ns = std::exchange(decode_ns_, 0);
  record.stages = clock_.take();
  record.ahead_cpu_ns = record.stages.sum_ns();
  if (timing_ == Timing::kFrames) record.decode_cpu_ns -= record.ahead_cpu_ns;
  return &frame_;
}

void PacketPipeline::label(Frame& frame) noexcept {
  frame.record.segmentation = method_->segment({*frame.returns, frame.image}, {}, &clock_);
  frame.record.stages += clock_.take();
}

}  // namespace terracut::run
