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

/// Publishes a value of one process to any others, which never delay the publisher: a page of
/// shared memory with a sequence lock (sequence_lock.hpp).
///
///     file in memory:  | StatusPageHeader, with the sequence | words of the value ... |
///
/// Readers map the page read-only, so nothing they do affects the publisher.
///
/// T must be trivially copyable, have no pointers, and have the same layout in all programs that
/// use the page: the owner of T raises the number `layout` in the header with every change of T.
template <class T>
class StatusPagePublisher {
  static_assert(std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>);

 public:
  /// Makes the page `name`; until the first publish() readers find no value. Fails with the errors
  /// of StatusPageFile::create(). Start-up only.
  [[nodiscard]] static Expected<StatusPagePublisher> create(
      const std::string& name, std::uint32_t layout,
      const std::filesystem::path& folder = status_page_folder()) {
    auto file = StatusPageFile::create(folder, name, layout, sizeof(T));
    if (!file) return tl::unexpected(file.error());
    return StatusPagePublisher(std::move(*file));
  }

  /// Publishes `value`; for one thread. Wait-free: memory accesses only, no system call.
  void publish(const T& value) noexcept TERRACUT_NONBLOCKING {
    queues::SequenceLock<T>::write(value, file_.header()->sequence, file_.words());
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return file_.path(); }

 private:
  explicit StatusPagePublisher(StatusPageFile file) : file_(std::move(file)) {}
  StatusPageFile file_;
};

/// Reads the value of a StatusPagePublisher with the same T and layout, in this process or another.
/// Movable; for one thread at a time.
template <class T>
class StatusPageReader {
  static_assert(std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>);

 public:
  /// Fails with the errors of StatusPageFile::open(). A page whose publisher has died can be
  /// opened; publisher_lives() is then false.
  [[nodiscard]] static Expected<StatusPageReader> open(
      const std::string& name, std::uint32_t layout,
      const std::filesystem::path& folder = status_page_folder()) {
    auto file = StatusPageFile::open(folder, name, layout, sizeof(T));
    if (!file) return tl::unexpected(file.error());
    return StatusPageReader(std::move(*file));
  }

  /// Returns the newest whole value. Returns nothing if none was published yet, or if all kTries
  /// tries met the publisher in the middle of writing, because it died or is held up. Try later.
  [[nodiscard]] std::optional<T> read() const noexcept TERRACUT_NONBLOCKING {
    return queues::SequenceLock<T>::read(file_.header()->sequence, file_.words(), kTries);
  }

  /// Returns how often a value was published, so that readers need not read an unchanged value.
  [[nodiscard]] std::uint64_t publications() const noexcept TERRACUT_NONBLOCKING {
    return file_.header()->sequence.load(std::memory_order_acquire) / 2;
  }

  /// True while the process that made this page lives. Once that process has ended, false for good;
  /// a new process makes a new page, for which open() must be called again.
  [[nodiscard]] bool publisher_lives() const noexcept { return file_.publisher_lives(); }

  [[nodiscard]] std::int32_t publisher_pid() const noexcept { return file_.header()->pid; }
  /// Returns when the page was made: nanoseconds since 1970, CLOCK_REALTIME.
  [[nodiscard]] std::int64_t started_ns() const noexcept { return file_.header()->started_ns; }

 private:
  static constexpr int kTries = 10'000;  // a publication of 1 KiB takes less than one try

  explicit StatusPageReader(StatusPageFile file) : file_(std::move(file)) {}
  StatusPageFile file_;
};

}  // namespace terracut::page
