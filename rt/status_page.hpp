// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "rt/error.hpp"
#include "rt/nonblocking.hpp"
#include "rt/status_page_file.hpp"

namespace terracut::rt {

/// A value that one process publishes and any others read, without the publisher ever noticing
/// them: a page of shared memory with a sequence lock.
///
///     file in memory:  | StatusPageHeader | words of the value ...                |
///                        sequence: 4        w0 w1 w2 ...        even: at rest
///     publish:           sequence: 5        w0'w1'w2 ...        odd: being written
///                        sequence: 6        w0'w1'w2'...        even again
///
/// A reader takes the sequence, the words, and the sequence again; when both are the same and even,
/// nothing was written in between. Otherwise it tries again. Readers map the page read-only, so
/// whatever one of them does or suffers, the publisher is not affected.
///
/// Why it is right. The words are atomic, so that reading while they are written is defined. Each
/// is stored with release and loaded with acquire: a reader that gets any word of publication n has
/// acquired the odd sequence stored before it, so its second look at the sequence shows n's odd
/// number or a later one, which differs from what it had seen first, unless that was n's even one.
/// And a reader that saw n's even sequence (acquire) sees no words older than n's.
///
/// T is trivially copyable, has no pointers in it, and the same layout in all programs that use the
/// page: `layout` in the header is a number the owner of T raises with every change to it.
template <class T>
class StatusPagePublisher {
  static_assert(std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>);

 public:
  /// Makes the page `name`. Until the first publish() readers find nothing published. Errors as
  /// StatusPageFile::create. Start-up only.
  [[nodiscard]] static Expected<StatusPagePublisher> create(
      const std::string& name, std::uint32_t layout,
      const std::filesystem::path& folder = status_page_folder()) {
    auto file = StatusPageFile::create(folder, name, layout, sizeof(T));
    if (!file) return tl::unexpected(file.error());
    return StatusPagePublisher(std::move(*file));
  }

  /// Wait-free, no system call: memory accesses only. One thread.
  void publish(const T& value) noexcept TERRACUT_NONBLOCKING {
    StatusPageHeader& header = *file_.header();
    const std::uint64_t sequence = header.sequence.load(std::memory_order_relaxed);
    header.sequence.store(sequence + 1, std::memory_order_relaxed);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t at = 0; at < sizeof(T); at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + at, std::min(sizeof word, sizeof(T) - at));
      file_.words()[at / sizeof word].store(word, std::memory_order_release);
    }
    header.sequence.store(sequence + 2, std::memory_order_release);
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return file_.path(); }

 private:
  explicit StatusPagePublisher(StatusPageFile file) : file_(std::move(file)) {}
  StatusPageFile file_;
};

/// Reads what a StatusPagePublisher of the same T and layout publishes, in this process or another.
/// Movable; one thread an object.
template <class T>
class StatusPageReader {
  static_assert(std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>);

 public:
  /// Errors as StatusPageFile::open. A page whose publisher has died opens like any other: see
  /// publisher_lives().
  [[nodiscard]] static Expected<StatusPageReader> open(
      const std::string& name, std::uint32_t layout,
      const std::filesystem::path& folder = status_page_folder()) {
    auto file = StatusPageFile::open(folder, name, layout, sizeof(T));
    if (!file) return tl::unexpected(file.error());
    return StatusPageReader(std::move(*file));
  }

  /// The newest whole value. None when nothing was published yet, or when no quiet moment was met
  /// in kTries tries: the publisher died while writing, or is being held up there. Try later.
  [[nodiscard]] std::optional<T> read() const noexcept TERRACUT_NONBLOCKING {
    const StatusPageHeader& header = *file_.header();
    for (int n = 0; n < kTries; ++n) {
      const std::uint64_t before = header.sequence.load(std::memory_order_acquire);
      if (before == 0) return std::nullopt;
      if (before % 2 != 0) continue;
      T value;
      auto* bytes = reinterpret_cast<unsigned char*>(&value);
      for (std::size_t at = 0; at < sizeof(T); at += sizeof(std::uint64_t)) {
        const std::uint64_t word =
            file_.words()[at / sizeof(std::uint64_t)].load(std::memory_order_acquire);
        std::memcpy(bytes + at, &word, std::min(sizeof word, sizeof(T) - at));
      }
      if (header.sequence.load(std::memory_order_relaxed) == before) return value;
    }
    return std::nullopt;
  }

  /// How often something was published: tells whether there is news without reading it.
  [[nodiscard]] std::uint64_t publications() const noexcept TERRACUT_NONBLOCKING {
    return file_.header()->sequence.load(std::memory_order_acquire) / 2;
  }

  /// Whether the process that made this page still has it. False for good once that has ended, by
  /// whatever way; a new process makes a new page, for which open() must be called again.
  [[nodiscard]] bool publisher_lives() const noexcept { return file_.publisher_lives(); }

  [[nodiscard]] std::int32_t publisher_pid() const noexcept { return file_.header()->pid; }
  /// When the page was made: nanoseconds since 1970, CLOCK_REALTIME.
  [[nodiscard]] std::int64_t started_ns() const noexcept { return file_.header()->started_ns; }

 private:
  static constexpr int kTries = 10'000;  // a publication of 1 KiB takes less than one of them

  explicit StatusPageReader(StatusPageFile file) : file_(std::move(file)) {}
  StatusPageFile file_;
};

}  // namespace terracut::rt
