// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::bag {

/// The most bytes of a message or of a chunk, packed and unpacked. A cloud of the most points has a
/// quarter of them.
inline constexpr std::size_t kMostBytes = std::size_t{1} << 28;

/// True if bytes begin as zstd's.
[[nodiscard]] bool begins_as_zstd(std::span<const std::byte> bytes) noexcept;

/// Unpacks frames of `compression`, "zstd" or "lz4" (MCAP's names), into `plain`, replacing its
/// content. On failure `plain` holds what came out before the fault, which is whole up to there.
/// Fails with kMalformed (broken or cut off, or more than kMostBytes) or kUnsupported (another
/// compression, or one that this program was built without).
[[nodiscard]] Status unpack(std::string_view compression, std::span<const std::byte> packed,
                            std::vector<std::byte>& plain);

/// As unpack(), for lz4.
[[nodiscard]] Status unpack_lz4(std::span<const std::byte> packed, std::vector<std::byte>& plain);

/// Unpacks a zstd file to the open file `to`. Fails with kMalformed (broken, or unpacked more than
/// a hundred times as large, which no recording is), kUnreadable or kWriteFailed.
[[nodiscard]] Status unpack_zstd_file(const std::filesystem::path& from, int to);

}  // namespace terracut::bag
