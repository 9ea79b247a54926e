// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/frame_builder.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace terracut::decode {
FrameBuilder::FrameBuilder(const Config& config, memory::FixedMemory& memory)
    : shape_(config.shape), revolution_ticks_(config.revolution_ticks) {
  if (config.shape.rows < 1 || config.shape.columns < 1 || config.revolution_ticks < 1) {
    throw std::invalid_argument("FrameBuilder needs at least one row, one column and one tick");
  }
  buffers_.reserve(kBuffers);
  for (std::size_t i = 0; i < kBuffers; ++i) {
    buffers_.emplace_back(config.shape, config.lasers, config.tiles, memory, config.has_fine);
  }
  open_[0].returns = &buffers_[0];
  open_[1].returns = &buffers_[1];
  free_ = &buffers_[2];
}

void FrameBuilder::open(std::size_t slot, std::int64_t frame,
                        frame::MeasuredReturns& buffer) noexcept {
  OpenFrame& opened = open_[slot];
  opened = OpenFrame{};
  opened.returns = &buffer;
  last_turn_ = std::max(last_turn_, frame + turn_of_frame_0_);
  buffer.clear(frame + turn_of_frame_0_);
  add_missing(opened, frame, last_gap_, +1, spread_);
}

void FrameBuilder::start(std::int64_t oldest_frame, std::int64_t rotor_ticks) noexcept {
  started_ = true;
  oldest_ = over_before_ = oldest_frame;
  turn_of_frame_0_ = last_turn_ + 2 - oldest_frame;  // no turn of a new stream follows an old one
  rolls_ = 0;
  start_ticks_ = frontier_ticks_ = rotor_ticks;
  last_gap_ = {};
  open(0, oldest_frame, *open_[0].returns);
  open(1, oldest_frame + 1, *open_[1].returns);
}

void FrameBuilder::add_missing(OpenFrame& frame, std::int64_t number, const Missing& missing,
                               int sign, const packet::BeamSpread& spread) noexcept {
  const packet::RotorInterval of_head{number * revolution_ticks_, (number + 1) * revolution_ticks_};
  const packet::RotorInterval of_beams{of_head.from_ticks - spread.foremost_ticks,
                                       of_head.to_ticks - spread.hindmost_ticks};
  if (missing.is_counted) {
    frame.hole_ticks += sign * blind_.outside_ticks(packet::intersection(missing.head, of_head));
  }
  frame.missing_ticks += sign * blind_.outside_ticks(packet::intersection(missing.head, of_beams));
}

void FrameBuilder::lose(packet::RotorInterval gap, const packet::BeamSpread& spread,
                        std::int64_t step_ticks, bool is_counted) noexcept {
  step_ticks_ = step_ticks;
  spread_ = spread;
  last_gap_ = {gap, is_counted};
  add_missing(open_[0], oldest_, last_gap_, +1, spread);
  add_missing(open_[1], oldest_ + 1, last_gap_, +1, spread);
}

void FrameBuilder::regain(packet::RotorInterval found, const packet::BeamSpread& spread) noexcept {
  add_missing(open_[0], oldest_, {found}, -1, spread);
  add_missing(open_[1], oldest_ + 1, {found}, -1, spread);
}

void FrameBuilder::note_packet(const PacketNote& packet, std::int64_t step_ticks,
                               const packet::BeamSpread& spread) noexcept {
  ++packets_;
  frontier_ticks_ = packet.frontier_ticks;
  step_ticks_ = step_ticks;
  spread_ = spread;
  for (std::int64_t frame = std::max(packet.first_frame, oldest_);
       frame <= std::min(packet.last_frame, oldest_ + 1); ++frame) {
    OpenFrame& touched = open_[static_cast<std::size_t>(frame - oldest_)];
    if (!touched.touched || packet.stamp_ns < touched.first_packet_ns) {
      touched.first_packet_ns = packet.stamp_ns;
      touched.first_ticks = packet.rotor_ticks;
    }
    if (!touched.touched || packet.stamp_ns > touched.last_packet_ns) {
      touched.last_packet_ns = packet.stamp_ns;
      touched.last_ticks = packet.rotor_ticks;
    }
    touched.touched = true;
  }
}

frame::HeadSweep FrameBuilder::head_of(const OpenFrame& frame) const noexcept {
  const auto turns = [&](std::int64_t rotor_ticks) noexcept {
    return static_cast<float>(rotor_ticks - oldest_ * revolution_ticks_) /
           static_cast<float>(revolution_ticks_);
  };
  return {turns(frame.first_ticks), turns(frame.last_ticks)};
}

bool FrameBuilder::seen_whole(const OpenFrame& frame) const noexcept {
  // Azimuths in packets are rounded, so a firing may be off by one rounding step: a gap of three
  // quarters of a firing step does not yet mean a missing firing.
  const std::int64_t slack_ticks = step_ticks_ * 3 / 4;
  const std::int64_t first_ticks = oldest_ * revolution_ticks_ - spread_.foremost_ticks;
  const std::int64_t end_ticks = (oldest_ + 1) * revolution_ticks_ - spread_.hindmost_ticks;
  return blind_.outside_ticks({first_ticks, start_ticks_}) <= slack_ticks &&
         blind_.outside_ticks({frontier_ticks_, end_ticks}) <= slack_ticks &&
         frame.missing_ticks < slack_ticks;
}

void FrameBuilder::count_holes(std::int64_t hole_ticks) noexcept {
  if (hole_ticks <= 0) return;
  losses_.azimuth_hole_columns +=
      static_cast<std::uint64_t>((hole_ticks + step_ticks_ / 2) / step_ticks_);
}

void FrameBuilder::pass_over(std::int64_t frame) noexcept {
  const packet::RotorInterval passed{oldest_ * revolution_ticks_, frame * revolution_ticks_};
  if (last_gap_.is_counted) {
    count_holes(blind_.outside_ticks(packet::intersection(last_gap_.head, passed)));
  }
  oldest_ = frame;
  open(0, frame, *open_[0].returns);
  open(1, frame + 1, *open_[1].returns);
}

bool FrameBuilder::close_oldest() noexcept {
  const OpenFrame closing = open_[0];
  count_holes(closing.hole_ticks);
  const bool has_returns = closing.returns->returns() > 0;
  if (has_returns) {
    frame_.returns = closing.returns;
    frame_.info = frame::FrameInfo{.number = frames_++,
                                   .first_packet_ns = closing.first_packet_ns,
                                   .last_packet_ns = closing.last_packet_ns,
                                   .head = head_of(closing),
                                   .packets = packets_,
                                   .returns = closing.returns->returns(),
                                   .complete = seen_whole(closing),
                                   .blind = {},
                                   .losses = losses_,
                                   .deskew = {}};
    losses_handed_over_ += losses_;
    losses_ = {};
    packets_ = 0;
  }
  return has_returns;
}

void FrameBuilder::roll_to(std::int64_t frame) noexcept {
  over_before_ = std::max(oldest_, frame);
  rolls_ = 2;
}

void FrameBuilder::flush() noexcept {
  if (!started_) return;
  roll_to(oldest_ + 2);
  is_ending_ = true;
}

frame::Frame* FrameBuilder::next() noexcept {
  if (frame_.returns != nullptr) {
    open_next(*std::exchange(free_, frame_.returns));
    frame_.returns = nullptr;
  }
  for (; oldest_ < over_before_ && rolls_ > 0; open_next(*open_[0].returns)) {
    --rolls_;
    if (close_oldest()) return &frame_;
  }
  if (oldest_ < over_before_) pass_over(over_before_);
  if (std::exchange(is_ending_, false)) started_ = false;
  return nullptr;
}

void FrameBuilder::open_next(frame::MeasuredReturns& buffer) noexcept {
  open_[0] = open_[1];
  ++oldest_;
  open(1, oldest_ + 1, buffer);
}

frame::LossCounters FrameBuilder::total_losses() const noexcept {
  frame::LossCounters total = losses_handed_over_;
  total += losses_;
  return total;
}

}  // namespace terracut::decode
