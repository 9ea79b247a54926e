// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "pipeline/page/status_page_file.hpp"
#include "rt/error.hpp"
#include "rt/queues/sequence_lock.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::page {

/// A value that one process publishes and any others read, without the publisher ever noticing
/// them: a page of shared memory with a sequence lock (sequence_lock.hpp).
///
///     file in memory:  | StatusPageHeader, with the sequence | words of the value ... |
///
/// Readers map the page read-only, so whatever one of them does or suffers, the publisher is not
/// affected.
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
    queues::SequenceLock<T>::write(value, file_.header()->sequence, file_.words());
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
    return queues::SequenceLock<T>::read(file_.header()->sequence, file_.words(), kTries);
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

}  // namespace terracut::page
