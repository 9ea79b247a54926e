// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>

#include "rt/fixed_memory.hpp"
#include "rt/frame_timing.hpp"
#include "rt/nonblocking.hpp"
#include "rt/spsc_queue.hpp"

namespace terracut::cli {

/// Carries frames' times from one thread with a deadline to the one that judges them. Where that
/// one is too slow, times are dropped and counted.
class FrameTimings {
 public:
  static constexpr std::size_t kRoom = 64;

  explicit FrameTimings(rt::FixedMemory& memory) : queue_("frame timings", kRoom, memory) {}

  /// Thread with a deadline.
  void pass_on(const rt::FrameTiming& timing) noexcept TERRACUT_NONBLOCKING {
    if (!queue_.try_push(timing)) dropped_.fetch_add(1, std::memory_order_relaxed);
  }
  /// The thread that judges: the oldest ones not taken yet.
  [[nodiscard]] bool take(rt::FrameTiming& timing) noexcept { return queue_.try_pop(timing); }
  /// Frames that nobody can judge. From any thread.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 private:
  rt::SpscQueue<rt::FrameTiming> queue_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace terracut::cli
