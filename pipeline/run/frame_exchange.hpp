// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/status/frame_timing.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::run {

/// Hands turns from the receiving thread to the segmenting one: always the newest, never a queue.
/// A turn that was not taken before the next one came is skipped, and counted by who hands over.
///
/// Images change hands one for one. The decoder has two open; here are three more: one being read,
/// the newest one, and one that the decoder gets back for its next turn.
class FrameExchange {
 public:
  static constexpr std::size_t kImages = 2 + queues::LatestSlot::kSlots;

  struct Turn {
    frame::RangeImage* image = nullptr;
    frame::FrameInfo info;
    status::FrameTiming timing;
    bool has_coarse_stages = false;  ///< Else they are still to be done.
  };

  /// `images`: the decoder's, kImages of them, of which the first two are open.
  explicit FrameExchange(std::span<frame::RangeImage> images) noexcept {
    for (std::size_t i = 0; i < turns_.size(); ++i) turns_[i].image = &images[2 + i];
  }

  /// Receiving thread: hands `turn` over and answers the image to go on with. Where the turn before
  /// it was never taken, on_skipped(const Turn&) is told.
  template <class OnSkipped>
  frame::RangeImage* hand_over(const Turn& turn, OnSkipped&& on_skipped) noexcept {
    Turn& slot = turns_[slots_.writer_slot()];
    frame::RangeImage* next = slot.image;
    slot = turn;
    if (slots_.publish()) on_skipped(turns_[slots_.writer_slot()]);
    return next;
  }
  /// Segmenting thread: the newest turn, if there is one it has not had; its own until the next
  /// call that returns one.
  [[nodiscard]] Turn* take_if_new() noexcept TERRACUT_NONBLOCKING {
    return slots_.take_if_new() ? &turns_[slots_.reader_slot()] : nullptr;
  }

 private:
  std::array<Turn, queues::LatestSlot::kSlots> turns_{};
  queues::LatestSlot slots_;
};

}  // namespace terracut::run
