// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

namespace terracut::queues {

/// Lets one writer publish a value to any number of readers, which never delay the writer:
///
///     at rest:   sequence: 4        w0 w1 w2 ...        even
///     write:     sequence: 5        w0'w1'w2 ...        odd: being written
///                sequence: 6        w0'w1'w2'...        even again
///
/// A reader loads the sequence, the words, and the sequence again; if both sequences are the same
/// and even, nothing was written in between. Otherwise it tries again.
///
/// Why it is right. The words are atomic, so that reading while they are written is defined. Each
/// is stored with release and loaded with acquire. A reader that gets a word of publication n has
/// acquired the odd sequence stored before it. So its second look at the sequence shows n's odd
/// number or a later one, which differs from its first look, unless that was n's even one. A reader
/// that saw n's even sequence (acquire) sees no words older than n's.
///
/// `Atomic` is std::atomic<std::uint64_t>; tests replace it by a model that tries everything the
/// memory model allows, whatever processor the tests run on.
template <class T, class Atomic = std::atomic<std::uint64_t>>
struct SequenceLock {
  static_assert(std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>);
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;

  /// Publishes `value`; for one thread only. Wait-free: accesses memory only, makes no system call.
  static void write(const T& value, Atomic& sequence, Atomic* words) noexcept {
    const std::uint64_t before = sequence.load(std::memory_order_relaxed);
    sequence.store(before + 1, std::memory_order_relaxed);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < kWords; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i * sizeof word,
                  std::min(sizeof word, sizeof(T) - i * sizeof word));
      words[i].store(word, std::memory_order_release);
    }
    sequence.store(before + 2, std::memory_order_release);
  }

  /// Returns the newest whole value; nothing if none was written yet, or if the writer was at work
  /// in every one of `tries` attempts. Any thread; never waits.
  [[nodiscard]] static std::optional<T> read(const Atomic& sequence, const Atomic* words,
                                             int tries) noexcept {
    for (int n = 0; n < tries; ++n) {
      const std::uint64_t before = sequence.load(std::memory_order_acquire);
      if (before == 0) return std::nullopt;
      if (before % 2 != 0) continue;
      T value;
      auto* bytes = reinterpret_cast<unsigned char*>(&value);
      for (std::size_t i = 0; i < kWords; ++i) {
        const std::uint64_t word = words[i].load(std::memory_order_acquire);
        std::memcpy(bytes + i * sizeof word, &word,
                    std::min(sizeof word, sizeof(T) - i * sizeof word));
      }
      if (sequence.load(std::memory_order_relaxed) == before) return value;
    }
    return std::nullopt;
  }
};

}  // namespace terracut::queues
