// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::page {

/// The beginning of a status page file; numbers are in the machine's byte order. The published
/// value follows from the next cache line on, as 64-bit words.
struct StatusPageHeader {
  static constexpr std::uint64_t kMagic = 0x65'67'61'70'74'63'72'74;  // "trctpage" in the file

  std::uint64_t magic = kMagic;
  std::uint32_t header_bytes = 64;  ///< Offset of the value's words.
  std::uint32_t layout = 0;         ///< The version of the value's layout.
  std::uint64_t value_bytes = 0;
  std::int64_t started_ns = 0;  ///< Time when the page was made, since 1970.
  std::int32_t pid = 0;         ///< Process number of the publisher, in its own container.
  std::uint32_t reserved = 0;
  std::atomic<std::uint64_t> sequence{0};  ///< Even: at rest; odd: in writing; 0: no value yet.
  std::uint64_t reserved_too[2]{};
};
static_assert(sizeof(StatusPageHeader) == 64);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free,
              "shared between processes, so nothing but the processor can keep it whole");

/// Returns the folder of status pages: $TERRACUT_STATUS_FOLDER if set, else /dev/shm, which every
/// user of the machine can read.
[[nodiscard]] std::filesystem::path status_page_folder();

/// The file of page `name` is `name` with this ending.
inline constexpr std::string_view kStatusPageEnding = ".terracut";

/// True if a living process holds the lock of the open page file.
[[nodiscard]] bool has_publisher(int file) noexcept;

/// The file of one status page, mapped into memory. The publisher holds a lock on the file, which
/// the kernel releases however the process ends. So a page in use is told from one left behind,
/// even if the process number is in use again, and between containers. Readers query the lock but
/// never take it. A forked process without a following exec shares the lock. Movable; start-up
/// only.
class StatusPageFile {
 public:
  StatusPageFile(StatusPageFile&& other) noexcept;
  StatusPageFile& operator=(StatusPageFile&& other) noexcept;
  /// If this object belongs to the publisher, removes the page.
  ~StatusPageFile();

  /// For the publisher: makes `name`.terracut in `folder`, whole or not at all, readable for all. A
  /// page that a dead process left behind is replaced. Fails with kInvalidArgument for a name that
  /// is not made of 1 to 64 letters, digits, '-', '_' and '.', or used by a living process (the
  /// message says which); kUnsupported for a folder on a disk, where publishing could wait;
  /// kWriteFailed with the system's reason.
  [[nodiscard]] static Expected<StatusPageFile> create(const std::filesystem::path& folder,
                                                       const std::string& name,
                                                       std::uint32_t layout,
                                                       std::size_t value_bytes);

  /// For readers. Fails with kNotFound if there is no such page; kUnreadable with the system's
  /// reason, or if anybody could have made it (trusted_file.hpp); kMalformed for a file that is no
  /// status page; kUnsupported for another layout or size.
  [[nodiscard]] static Expected<StatusPageFile> open(const std::filesystem::path& folder,
                                                     const std::string& name, std::uint32_t layout,
                                                     std::size_t value_bytes);

  [[nodiscard]] StatusPageHeader* header() const noexcept { return header_; }
  /// Returns the words after the header: the value in words of eight bytes, the last padded with
  /// zeros.
  [[nodiscard]] std::atomic<std::uint64_t>* words() const noexcept { return words_; }
  [[nodiscard]] bool publisher_lives() const noexcept { return has_publisher(file_.get()); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  StatusPageFile() = default;

  std::filesystem::path path_;
  files::OwnedDescriptor file_;  ///< On the publisher's side it holds the lock.
  bool publishes_ = false;
  std::size_t mapped_bytes_ = 0;
  StatusPageHeader* header_ = nullptr;
  std::atomic<std::uint64_t>* words_ = nullptr;
};

}  // namespace terracut::page
