// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "rt/error.hpp"

namespace terracut::rt {

/// A status page: one value of one running process, which others read from shared memory without
/// the process noticing. It is a file terracut.NAME.status in memory (status_folder()).
///
///     one writer                    file in /dev/shm                      any number of readers
///   +-------------+  publish   +--------------------------+    read     +-----------------------+
///   | process     | ---------> | magic, layout, size, pid,| ----------> | mapped read-only: can |
///   | holds lock  |            | start | sequence | value |             | neither stall nor     |
///   +-------------+            +--------------------------+             | change anything       |
///
/// Sequence lock: the sequence is odd while the value is being written. A reader copies the value
/// between two looks at the sequence and takes the copy only if both saw the same even number.
/// Memory order: the words of the value are stored with release and loaded with acquire. So a
/// reader that saw even one word of a newer value also sees, in its second look, the odd sequence
/// that was stored before that word, and rejects the copy. Every access is atomic: no data race.
///
/// Whether the writer lives is told by the system, not by its pid, which may be used again: the
/// writer holds a lock on the file (F_OFD_SETLK), and the kernel gives it up when the process ends,
/// however it ends. A page that nobody locks is stale; the next process of that name replaces it.

/// Where status pages are: $TERRACUT_STATUS_DIR, or /dev/shm, which every user of the machine can
/// look into.
[[nodiscard]] std::filesystem::path status_folder();

/// The start of the file. The value follows at kValueOffset.
struct StatusPageHeader {
  std::uint64_t magic;  ///< kMagic, written when all else is in place.
  std::uint32_t layout;
  std::uint32_t pid;
  std::uint64_t value_bytes;
  std::int64_t started_ns;  ///< When the page was made, CLOCK_REALTIME.
  std::uint64_t sequence;

  static constexpr std::uint64_t kMagic = 0x6567'6170'7463'7274;  // "trctpage" in little endian
};
inline constexpr std::size_t kStatusValueOffset = 64;
static_assert(sizeof(StatusPageHeader) <= kStatusValueOffset);

/// Page and lock of a status page, without knowing its value. See StatusPage and StatusPageView.
class StatusPageFile {
 public:
  static Expected<StatusPageFile> create(const std::filesystem::path& folder, std::string_view name,
                                         std::uint32_t layout, std::size_t value_bytes);
  static Expected<StatusPageFile> open(const std::filesystem::path& folder, std::string_view name,
                                       std::uint32_t layout, std::size_t value_bytes);
  StatusPageFile(StatusPageFile&& other) noexcept { swap(other); }
  StatusPageFile& operator=(StatusPageFile&& other) noexcept {
    swap(other);
    return *this;
  }
  ~StatusPageFile();

  [[nodiscard]] StatusPageHeader& header() const noexcept;
  [[nodiscard]] std::uint64_t* value() const noexcept;
  [[nodiscard]] bool locked_by_writer() const noexcept;

 private:
  StatusPageFile() = default;
  void swap(StatusPageFile& other) noexcept;
  [[nodiscard]] Status map(std::size_t value_bytes, bool writable);

  std::filesystem::path path_;
  int file_ = -1;
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
  bool own_ = false;  ///< Made by this object, and removed with it.
};

/// The writer's side. One thread at a time.
template <class T>
class StatusPage {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint64_t) == 0);

 public:
  /// Makes the page and holds it until this object goes. `name`: 1 to 64 letters, digits, '-', '_'.
  /// Errors: kInvalidArgument for a name that is none, or that a running process uses (with its
  /// pid); kWriteFailed with the system's reason.
  [[nodiscard]] static Expected<StatusPage> create(const std::filesystem::path& folder,
                                                   std::string_view name, std::uint32_t layout) {
    return StatusPageFile::create(folder, name, layout, sizeof(T)).map([](StatusPageFile&& file) {
      return StatusPage(std::move(file));
    });
  }

  /// Wait-free, no system call: readers cannot hold it up.
  void publish(const T& value) noexcept {
    const std::atomic_ref sequence(file_.header().sequence);
    const std::uint64_t even = sequence.load(std::memory_order_relaxed);
    sequence.store(even + 1, std::memory_order_relaxed);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    std::uint64_t* words = file_.value();
    for (std::size_t i = 0; i < sizeof(T) / sizeof(std::uint64_t); ++i) {
      std::uint64_t word;
      std::memcpy(&word, bytes + i * sizeof(word), sizeof(word));
      std::atomic_ref(words[i]).store(word, std::memory_order_release);
    }
    sequence.store(even + 2, std::memory_order_release);
  }

 private:
  explicit StatusPage(StatusPageFile&& file) : file_(std::move(file)) {}
  StatusPageFile file_;
};

/// A reader's side. One thread at a time.
template <class T>
class StatusPageView {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint64_t) == 0);

 public:
  /// Also opens the page that a dead process left: see writer_lives(). Errors: kNotFound;
  /// kUnreadable with the system's reason; kMalformed for what is no status page or not yet one;
  /// kUnsupported for one of another layout.
  [[nodiscard]] static Expected<StatusPageView> open(const std::filesystem::path& folder,
                                                     std::string_view name, std::uint32_t layout) {
    return StatusPageFile::open(folder, name, layout, sizeof(T)).map([](StatusPageFile&& file) {
      return StatusPageView(std::move(file));
    });
  }

  /// Copies the newest value. False if none was published yet, or the writer wrote during every one
  /// of a thousand attempts, or died while writing; then `into` holds anything.
  [[nodiscard]] bool read(T& into) const noexcept {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      if (try_read(into)) return true;
    }
    return false;
  }

  [[nodiscard]] bool writer_lives() const noexcept { return file_.locked_by_writer(); }
  [[nodiscard]] std::uint32_t pid() const noexcept { return file_.header().pid; }
  /// When the writer made the page, CLOCK_REALTIME.
  [[nodiscard]] std::int64_t started_ns() const noexcept { return file_.header().started_ns; }

 private:
  explicit StatusPageView(StatusPageFile&& file) : file_(std::move(file)) {}

  [[nodiscard]] bool try_read(T& into) const noexcept {
    const std::atomic_ref sequence(file_.header().sequence);
    const std::uint64_t before = sequence.load(std::memory_order_acquire);
    if (before == 0 || before % 2 != 0) return false;
    auto* bytes = reinterpret_cast<std::byte*>(&into);
    std::uint64_t* words = file_.value();
    for (std::size_t i = 0; i < sizeof(T) / sizeof(std::uint64_t); ++i) {
      const std::uint64_t word = std::atomic_ref(words[i]).load(std::memory_order_acquire);
      std::memcpy(bytes + i * sizeof(word), &word, sizeof(word));
    }
    return sequence.load(std::memory_order_relaxed) == before;
  }

  StatusPageFile file_;
};

/// A page found in a folder.
struct StatusPageEntry {
  std::string name;
  std::uint32_t pid = 0;
  bool writer_lives = false;
};

/// All status pages of `folder`, whatever their layout, by name. What cannot be read is left out.
[[nodiscard]] std::vector<StatusPageEntry> list_status_pages(const std::filesystem::path& folder);

}  // namespace terracut::rt
