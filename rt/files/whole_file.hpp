// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::files {

/// Writes `content` to `path` whole or not at all: under a temporary name in the same folder first,
/// then renamed over `path`. Missing parent folders are made. On an error (kWriteFailed, with the
/// path and the system's reason) nothing is left behind and a file that stood at `path` is
/// untouched. Blocks on the disk: never call it from a real-time thread.
[[nodiscard]] Status write_whole_file(const std::filesystem::path& path,
                                      std::span<const std::byte> content);
[[nodiscard]] Status write_whole_file(const std::filesystem::path& path, std::string_view text);
/// Writes content too large for memory, piece by piece: `next` returns the pieces and an empty one
/// at the end. Its error is passed on.
[[nodiscard]] Status write_whole_file(const std::filesystem::path& path,
                                      const std::function<Expected<std::string_view>()>& next);

}  // namespace terracut::files
