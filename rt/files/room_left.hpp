// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>

#include "rt/error.hpp"

namespace terracut::files {

/// Returns how many bytes recordings leave free for others, such as logs, on a file system of so
/// many bytes: a tenth, at most 1 GiB.
[[nodiscard]] constexpr std::uint64_t room_for_others(std::uint64_t total_bytes) noexcept {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30;
  return total_bytes / 10 < kMost ? total_bytes / 10 : kMost;
}

/// Checks that a recording may grow at `path`, which need not exist: its file system has more free
/// than room_for_others(). kWriteFailed states both. One system call, and one for each missing
/// folder.
[[nodiscard]] Status check_room_left(const std::filesystem::path& path);

}  // namespace terracut::files
