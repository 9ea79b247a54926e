// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::queues {

/// Hands the newest of three slots from one thread to one other. The writer never waits, the
/// reader never waits, and the reader gets the newest whole value, never a torn or an older one.
/// The slots themselves lie elsewhere (LatestValue, or a pool of three frames).
///
///      writer_slot()                                  reader_slot()
///     +-------------+        +-------------+        +-------------+
///     |  being      |        |  between:   |        |  being      |
///     |  written    |        |  newest, or |        |  read       |
///     +-------------+        |  taken back |        +-------------+
///            |               +-------------+               |
///            '---- publish() ----^     ^---- take_if_new() ----'
///                 swaps these two       swaps these two, if the one between is new
///
/// Why it is right. The three numbers 0, 1, 2 are always divided between writer, reader and the
/// one atomic byte between them; both sides change it by an exchange only, so a number is never in
/// two places. The exchange of publish() releases what was written into the slot, the exchange of
/// take_if_new() acquires it; and the other way round the exchange of take_if_new() releases the
/// slot that was read, and the exchange of publish() acquires it before it is overwritten. Hence
/// both are acq_rel. The look at the flag beforehand is relaxed: the exchange behind it does the
/// ordering, and only the reader takes the flag away, so what was seen set stays set.
///
/// Thread contract: writer_slot() and publish() from one thread, reader_slot() and take_if_new()
/// from one thread (the same or another). Wait-free where the processor has an atomic exchange
/// (x86-64, ARMv8.1), lock-free elsewhere.
class LatestSlot {
 public:
  static constexpr std::size_t kSlots = 3;

  LatestSlot() = default;
  LatestSlot(const LatestSlot&) = delete;
  LatestSlot& operator=(const LatestSlot&) = delete;

  /// For the writer: returns the slot to fill, in [0, kSlots). The slot holds an older value;
  /// overwrite all of it.
  [[nodiscard]] std::size_t writer_slot() const noexcept TERRACUT_NONBLOCKING { return writers_; }

  /// For the writer: makes writer_slot() the newest and gets another slot to fill. True if the
  /// value published before was never taken: the reader missed it.
  bool publish() noexcept TERRACUT_NONBLOCKING {
    const std::uint8_t before =
        between_.exchange(static_cast<std::uint8_t>(writers_ | kNew), std::memory_order_acq_rel);
    writers_ = before & kNumber;
    return (before & kNew) != 0;
  }

  /// For the reader: takes the newest slot if one was published since the last call. reader_slot()
  /// is then that slot until the next call that returns true.
  [[nodiscard]] bool take_if_new() noexcept TERRACUT_NONBLOCKING {
    if ((between_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    const std::uint8_t before = between_.exchange(readers_, std::memory_order_acq_rel);
    readers_ = before & kNumber;
    return true;
  }

  /// For the reader: returns the slot taken last, in [0, kSlots); before the first, a slot with its
  /// initial value.
  [[nodiscard]] std::size_t reader_slot() const noexcept TERRACUT_NONBLOCKING { return readers_; }

 private:
  static constexpr std::uint8_t kNumber = 3;
  static constexpr std::uint8_t kNew = 4;  // published, not taken yet

  alignas(memory::FixedMemory::kAlignment) std::atomic<std::uint8_t> between_{1};
  alignas(memory::FixedMemory::kAlignment) std::uint8_t writers_ = 0;
  alignas(memory::FixedMemory::kAlignment) std::uint8_t readers_ = 2;
};

/// Owns three values with their LatestSlot. T is default-constructible, and for publish(value)
/// copying a T must not allocate. Thread contract: as LatestSlot.
template <class T>
class LatestValue {
 public:
  /// For the writer: returns the value to fill before publish(). Overwrite all of its old content.
  [[nodiscard]] T& draft() noexcept TERRACUT_NONBLOCKING {
    return values_[slots_.writer_slot()].value;
  }

  /// For the writer: publishes the draft. True if the value published before was never taken.
  bool publish() noexcept TERRACUT_NONBLOCKING { return slots_.publish(); }

  /// For the writer: publishes a copy of `value`.
  bool publish(const T& value) noexcept TERRACUT_NONBLOCKING {
    draft() = value;
    return publish();
  }

  /// For the reader: returns the newest value if it has not been taken yet, else nullptr. The value
  /// stays unchanged until the next call that returns one.
  [[nodiscard]] const T* take_if_new() noexcept TERRACUT_NONBLOCKING {
    return slots_.take_if_new() ? &newest_taken() : nullptr;
  }

  /// For the reader: returns the value last taken by take_if_new(); before the first, a
  /// default-constructed T.
  [[nodiscard]] const T& newest_taken() const noexcept TERRACUT_NONBLOCKING {
    return values_[slots_.reader_slot()].value;
  }

 private:
  // Aligned so that no cache line holds two values.
  struct alignas(memory::FixedMemory::kAlignment) Slot {
    T value{};
  };
  std::array<Slot, LatestSlot::kSlots> values_{};
  LatestSlot slots_;
};

}  // namespace terracut::queues
