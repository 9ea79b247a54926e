// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "pipeline/status/frame_record.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/spsc_queue.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Carries results, one T per return, from the labelling thread to one thread without a deadline,
/// frame by frame (or sector by sector: sector_pool.hpp). If that thread is too slow, frames are
/// left out and counted.
///
///   labelling thread   pass_on() --full--> take()       the other thread
///                          ^                  |
///                          '------ free ---- give_back()
template <class T, class Record = status::FrameRecord>
class FramePool {
 public:
  struct Frame {
    Record record;  ///< Complete except for what happens after labelling.
    std::span<const T> items;
    std::span<const float> heights_m;  ///< One per item, above the ground; empty if not passed on.
  };
  /// Whether returns come with their heights above the ground.
  enum class Heights : std::uint8_t { kLeftOut, kKept };

  /// Takes room for `slots` frames of at most `capacity` returns.
  FramePool(std::string_view name, std::size_t slots, std::size_t capacity,
            memory::FixedMemory& memory, Heights heights = Heights::kLeftOut)
      : full_(name, slots, memory), free_(name, slots, memory) {
    slots_ = memory.take<Slot>(name, slots);
    for (std::uint32_t i = 0; i < slots; ++i) {
      slots_[i].room = memory.take<T>(name, capacity);
      if (heights == Heights::kKept) slots_[i].height_room = memory.take<float>(name, capacity);
      (void)free_.try_push(i);
    }
  }

  /// To be called on the labelling thread: passes a frame on. `fill(std::span<T>)` writes the
  /// `returns` items of the frame. `heights_m` are copied if they are kept. Real-time safe if
  /// `fill` is.
  template <class Fill>
  void pass_on(const Record& record, std::size_t returns, Fill&& fill,
               std::span<const float> heights_m = {}) noexcept {
    std::uint32_t i = 0;
    if (!free_.try_pop(i)) {
      unused_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    waiting_.fetch_add(1, std::memory_order_relaxed);
    Slot& slot = slots_[i];
    slot.record = record;
    slot.returns = returns;
    fill(slot.room.first(returns));
    slot.heights = std::min(heights_m.size(), slot.height_room.size());
    std::copy_n(heights_m.begin(), slot.heights, slot.height_room.begin());
    (void)full_.try_push(i);  // never fails: the queue has room for all slots
  }

  /// To be called on the other thread: takes the next frame, if any, valid until give_back().
  [[nodiscard]] bool take(Frame& frame) noexcept {
    if (!full_.try_pop(taken_)) return false;
    const Slot& slot = slots_[taken_];
    frame = {slot.record, slot.room.first(slot.returns), slot.height_room.first(slot.heights)};
    return true;
  }
  /// Gives the taken frame's slot back. `used` is true if the frame reached its destination.
  void give_back(bool used) noexcept {
    waiting_.fetch_sub(1, std::memory_order_relaxed);
    if (!used) unused_.fetch_add(1, std::memory_order_relaxed);
    (void)free_.try_push(taken_);
  }

  /// Returns how many frames found no room or were given back unused. This and the next function
  /// may be called on any thread.
  [[nodiscard]] std::uint64_t unused() const noexcept { return unused_.load(); }
  /// Returns how many frames have not been given back yet. They are lost if the other thread hangs
  /// for good.
  [[nodiscard]] std::uint64_t waiting() const noexcept { return waiting_.load(); }

 private:
  struct Slot {
    Record record;
    std::size_t returns = 0;
    std::span<T> room;
    std::size_t heights = 0;
    std::span<float> height_room;
  };

  queues::SpscQueue<std::uint32_t> full_, free_;
  std::span<Slot> slots_;
  std::uint32_t taken_ = 0;
  std::atomic<std::uint64_t> unused_{0}, waiting_{0};
};

}  // namespace terracut::live
