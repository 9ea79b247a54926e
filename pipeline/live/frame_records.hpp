// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>

#include "pipeline/status/frame_record.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/spsc_queue.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Carries frames' records from one thread with a deadline to the thread that judges the frames. If
/// that thread is too slow, records are dropped and counted.
class FrameRecords {
 public:
  static constexpr std::size_t kRoom = 64;

  explicit FrameRecords(memory::FixedMemory& memory) : queue_("frame records", kRoom, memory) {}

  /// Passes a record on; to be called on the thread with a deadline.
  void pass_on(const status::FrameRecord& record) noexcept TERRACUT_NONBLOCKING {
    if (!queue_.try_push(record)) dropped_.fetch_add(1, std::memory_order_relaxed);
  }
  /// To be called on the judging thread: takes the oldest record not taken yet.
  [[nodiscard]] bool take(status::FrameRecord& record) noexcept { return queue_.try_pop(record); }
  /// Returns how many frames cannot be judged because their records were dropped. For any thread.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 private:
  queues::SpscQueue<status::FrameRecord> queue_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace terracut::live
