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

/// Writes `content` to `path` whole or not at all: first under a temporary name in the same folder,
/// which is then renamed to `path`. Makes missing parent folders. On failure (kWriteFailed, with
/// the path and the system's reason) leaves nothing behind, and a file already at `path` is
/// untouched. Blocks on the disk: never call this from a real-time thread.
[[nodiscard]] Status write_whole_file(const std::filesystem::path& path,
                                      std::span<const std::byte> content);
[[nodiscard]] Status write_whole_file(const std::filesystem::path& path, std::string_view text);
/// Writes content too large for memory, piece by piece: each call of `next` returns a piece, and an
/// empty one at the end. If `next` fails, this returns its error.
[[nodiscard]] Status write_whole_file(const std::filesystem::path& path,
                                      const std::function<Expected<std::string_view>()>& next);

}  // namespace terracut::files
