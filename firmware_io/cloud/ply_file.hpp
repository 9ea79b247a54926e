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
/// `binary_little_endian` or `binary_big_endian`). The vertices must be the first element; lists in
/// them are skipped, and later elements (such as faces) are ignored. Fails as read_pcd() does.
[[nodiscard]] Expected<FieldTable> read_ply(const std::filesystem::path& path);
/// Parses a PLY file in memory; `name` stands for the path in messages.
[[nodiscard]] Expected<FieldTable> parse_ply(std::string_view content, const std::string& name);

}  // namespace terracut::cloud
