// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "firmware_io/cloud/field_table.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Reads the vertices of a PLY file (Stanford's polygon format, 1.0: `ascii`,
/// `binary_little_endian` or `binary_big_endian`). The vertices must be the first element; their
/// lists are skipped, and later elements (faces, say) are ignored. Errors as those of read_pcd().
[[nodiscard]] Expected<FieldTable> read_ply(const std::filesystem::path& path);
/// Reads from memory; `name` stands for the path in messages.
[[nodiscard]] Expected<FieldTable> parse_ply(std::string_view content, const std::string& name);

}  // namespace terracut::cloud
