// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "rt/error.hpp"

namespace terracut::scan {

/// Returns the class of a SemanticKITTI label, its low 16 bits; the high 16 bits number the
/// instance.
[[nodiscard]] constexpr std::uint16_t semantic_class(std::uint32_t label) noexcept {
  return static_cast<std::uint16_t>(label & 0xFFFFU);
}

/// Reads a SemanticKITTI `.label` file: one little-endian uint32 per point, no header. Reuses the
/// memory of `labels`. `points` is the number of labels that the scan needs; 0 accepts any number.
/// Fails with kNotFound, kUnreadable or kMalformed (truncated, empty, count differs from `points`).
[[nodiscard]] Status read_label_file(const std::filesystem::path& path, std::size_t points,
                                     std::vector<std::uint32_t>& labels);

/// Writes a `.label` file, whole or not at all. Fails with kWriteFailed.
[[nodiscard]] Status write_label_ids(const std::filesystem::path& path,
                                     std::span<const std::uint32_t> labels);

}  // namespace terracut::scan
