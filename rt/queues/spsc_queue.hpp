// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::queues {

/// Passes values from one thread to one other, first in first out; neither ever waits. For small
/// values, such as slot numbers in a pool of frames.
///
///            popped_                pushed_           Both only count upwards; value n lies in
///               |                      |              slot n modulo the number of slots (a power
///               v                      v              of two, so that the counts may wrap).
///     +---+---+---+---+---+---+---+---+---+---+
///     |   |   | n |n+1|n+2|n+3|n+4|n+5|   |   |       empty: pushed_ - popped_ == 0
///     +---+---+---+---+---+---+---+---+---+---+       full:  pushed_ - popped_ == capacity
///              the consumer     ^      the producer
///              reads here       |      writes here
///                 pushed_seen_ (consumer's copy)
///
/// Why it is right. A slot belongs to the consumer while its number is in [popped_, pushed_), else
/// to the producer, and each count is written by one thread only:
///  * The producer writes the value, then stores pushed_ with release; the consumer loads pushed_
///    with acquire before it reads. So the write of a value happens before its reading.
///  * The consumer reads the value, then stores popped_ with release; the producer loads popped_
///    with acquire before it reuses the slot. So the reading happens before the next write there.
///  * A thread loads its own count relaxed: nobody else writes it.
/// Why it is quick. Each side keeps its own copy of the other's count and looks at the real one
/// only when the copy says full (or empty): the cache line of a count changes hands once a batch,
/// not once a value. An old copy is harmless: the other side's count only grows, so it can make
/// the queue look fuller (or emptier) than it is, never the reverse. What the two sides write lies
/// on different cache lines.
///
/// Thread contract: try_push from one thread, try_pop from one thread (the same or another), other
/// functions from any. Wait-free: every call ends after a bounded number of instructions.
template <class T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>, "values are copied between threads bit by bit");

 public:
  /// Takes memory for `capacity` values, named `part` in the plan. A queue of capacity 0 is always
  /// full and always empty.
  SpscQueue(std::string_view part, std::size_t capacity, memory::FixedMemory& memory)
      : slots_(memory.take<T>(part, std::bit_ceil(capacity))), capacity_(capacity) {}
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  /// For the producer: pushes a value. False, and the queue unchanged, if it is full.
  [[nodiscard]] bool try_push(const T& value) noexcept TERRACUT_NONBLOCKING {
    const std::size_t number = pushed_.load(std::memory_order_relaxed);
    if (number - popped_seen_ >= capacity_) {
      popped_seen_ = popped_.load(std::memory_order_acquire);
      if (number - popped_seen_ >= capacity_) return false;
    }
    slots_[number & (slots_.size() - 1)] = value;
    pushed_.store(number + 1, std::memory_order_release);
    return true;
  }

  /// For the consumer: pops the oldest value. False, and `value` unchanged, if the queue is empty.
  [[nodiscard]] bool try_pop(T& value) noexcept TERRACUT_NONBLOCKING {
    const std::size_t number = popped_.load(std::memory_order_relaxed);
    if (number == pushed_seen_) {
      pushed_seen_ = pushed_.load(std::memory_order_acquire);
      if (number == pushed_seen_) return false;
    }
    value = slots_[number & (slots_.size() - 1)];
    popped_.store(number + 1, std::memory_order_release);
    return true;
  }

  /// Returns how many values wait, [0, capacity]. Exact while neither side is at work; else the
  /// true count at some moment of the call, or a number between two such counts.
  [[nodiscard]] std::size_t size_approx() const noexcept TERRACUT_NONBLOCKING {
    // popped_ is read first: a pushed_ read afterwards is at least as high, so the difference
    // cannot be negative. Values popped in between can make it too large, hence the limit.
    const std::size_t popped = popped_.load(std::memory_order_acquire);
    const std::size_t pushed = pushed_.load(std::memory_order_acquire);
    return std::min(pushed - popped, capacity_);
  }

 private:
  static constexpr std::size_t kCacheLine = memory::FixedMemory::kAlignment;

  // Never written after construction, so both sides share these at no cost.
  std::span<T> slots_;
  std::size_t capacity_;

  // Written by the producer only.
  alignas(kCacheLine) std::atomic<std::size_t> pushed_{0};
  std::size_t popped_seen_ = 0;

  // Written by the consumer only. The class ends with a whole cache line, to keep neighbours off
  // it.
  alignas(kCacheLine) std::atomic<std::size_t> popped_{0};
  std::size_t pushed_seen_ = 0;
};

}  // namespace terracut::queues
