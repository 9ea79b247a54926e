// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>

#include "pipeline/status/frame_timing.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/spsc_queue.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::run {

/// Carries frames' times from one thread with a deadline to the one that judges them. Where that
/// one is too slow, times are dropped and counted.
class FrameTimings {
 public:
  static constexpr std::size_t kRoom = 64;

  explicit FrameTimings(memory::FixedMemory& memory) : queue_("frame timings", kRoom, memory) {}

  /// Thread with a deadline.
  void pass_on(const status::FrameTiming& timing) noexcept TERRACUT_NONBLOCKING {
    if (!queue_.try_push(timing)) dropped_.fetch_add(1, std::memory_order_relaxed);
  }
  /// The thread that judges: the oldest ones not taken yet.
  [[nodiscard]] bool take(status::FrameTiming& timing) noexcept { return queue_.try_pop(timing); }
  /// Frames that nobody can judge. From any thread.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 private:
  queues::SpscQueue<status::FrameTiming> queue_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace terracut::run
