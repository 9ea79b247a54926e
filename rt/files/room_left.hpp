// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>

#include "rt/error.hpp"

namespace terracut::files {

/// What recordings leave of a file system of so many bytes to others, its logs say: a tenth of it,
/// 1 GiB at most.
[[nodiscard]] constexpr std::uint64_t room_for_others(std::uint64_t total_bytes) noexcept {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 30;
  return total_bytes / 10 < kMost ? total_bytes / 10 : kMost;
}

/// That a recording may grow at `path`, which need not be there: what is free on its file system is
/// more than room_for_others(). kWriteFailed, with both. One system call, or one a missing folder.
[[nodiscard]] Status check_room_left(const std::filesystem::path& path);

}  // namespace terracut::files
