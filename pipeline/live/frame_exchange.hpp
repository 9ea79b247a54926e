// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware_io/frame/measured_returns.hpp"
#include "pipeline/run/frame.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Hands frames from the receiving thread to the segmenting one: always the newest, without a
/// queue. A frame that is not taken before the next one comes is skipped, and the receiving thread
/// counts it.
///
/// Buffers of returns are exchanged one for one. The decoder has two open ones; this object has
/// three more: the one being read, the newest one, and one that the decoder gets back for its next
/// frame.
class FrameExchange {
 public:
  static constexpr std::size_t kBuffers = 2 + queues::LatestSlot::kSlots;

  /// `buffers` are the decoder's kBuffers; the first two are open in the decoder.
  explicit FrameExchange(std::span<frame::MeasuredReturns> buffers) noexcept {
    for (std::size_t i = 0; i < frames_.size(); ++i) frames_[i].returns = &buffers[2 + i];
  }

  /// To be called on the receiving thread: hands `frame` over and returns the next buffer to use.
  /// Calls on_skipped(Frame&) if the previous frame was never taken.
  template <class OnSkipped>
  frame::MeasuredReturns* hand_over(const run::Frame& frame, OnSkipped&& on_skipped) noexcept {
    run::Frame& slot = frames_[slots_.writer_slot()];
    frame::MeasuredReturns* next = slot.returns;
    slot = frame;
    if (slots_.publish()) on_skipped(frames_[slots_.writer_slot()]);
    return next;
  }
  /// To be called on the segmenting thread: returns the newest frame unless it was taken before.
  /// The frame may be used until the next call that returns one.
  [[nodiscard]] run::Frame* take_if_new() noexcept TERRACUT_NONBLOCKING {
    return slots_.take_if_new() ? &frames_[slots_.reader_slot()] : nullptr;
  }

 private:
  std::array<run::Frame, queues::LatestSlot::kSlots> frames_{};
  queues::LatestSlot slots_;
};

}  // namespace terracut::live
