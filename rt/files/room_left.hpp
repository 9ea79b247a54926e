// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>

#include "rt/error.hpp"

namespace terracut::files {

/// Returns how many bytes recordings leave free for other files, such as logs, on a file system of
/// `total_bytes`: a tenth, at most 1 GiB.
[[nodiscard]] constexpr std::uint64_t room_for_others(std::uint64_t total_bytes) noexcept {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30;
  return total_bytes / 10 < kMost ? total_bytes / 10 : kMost;
}

/// Checks that the file system of `path` (which need not exist) has more free bytes than
/// room_for_others(). If not, fails with kWriteFailed; the message states both numbers. Makes one
/// system call, and one more for each missing folder.
[[nodiscard]] Status check_room_left(const std::filesystem::path& path);

}  // namespace terracut::files
