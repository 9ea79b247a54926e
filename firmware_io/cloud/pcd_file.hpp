// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "firmware_io/cloud/field_table.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Reads a PCD file (the Point Cloud Library's format: a header that names the fields, then `DATA
/// ascii`, `binary` or `binary_compressed`, little-endian), versions 0.5 to 0.7, and these common
/// deviations: lower-case TYPE, COUNT 0, WIDTH and HEIGHT without POINTS, a byte order mark, blank
/// lines and comments among text. It may have no points. kNotFound, kUnreadable, kMalformed,
/// kUnsupported; the message names the file, the line of the header or the point, what was found
/// and what expected.
[[nodiscard]] Expected<FieldTable> read_pcd(const std::filesystem::path& path);
/// Reads from memory; `name` stands for the path in messages.
[[nodiscard]] Expected<FieldTable> parse_pcd(std::string_view content, const std::string& name);

}  // namespace terracut::cloud
