// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/ground/near_ground.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Carries the near ground of some frames from the labelling thread to the thread that checks the
/// mount. One thread on each side; neither thread waits for the other.
class LatestNearGround {
 public:
  /// One frame in this many is examined: two per second at 10 Hz.
  static constexpr std::uint32_t kFramesApart = 5;

  explicit LatestNearGround(memory::FixedMemory& memory)
      : slots_(memory.take<ground::NearGround>("near ground", queues::LatestSlot::kSlots)) {}

  /// To be called on the labelling thread: draft() is filled in, then publish() passes it on.
  [[nodiscard]] ground::NearGround& draft() noexcept { return slots_[slot_.writer_slot()]; }
  void publish() noexcept { (void)slot_.publish(); }
  /// To be called on the checking thread: returns the newest near ground, or null if it was
  /// returned before. Valid until the next call.
  [[nodiscard]] const ground::NearGround* newest() noexcept {
    return slot_.take_if_new() ? &slots_[slot_.reader_slot()] : nullptr;
  }

 private:
  std::span<ground::NearGround> slots_;
  queues::LatestSlot slot_;
};

}  // namespace terracut::live
