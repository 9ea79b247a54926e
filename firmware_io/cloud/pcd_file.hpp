// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "firmware_io/cloud/field_table.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Reads a PCD file of the Point Cloud Library, versions 0.5 to 0.7 (a header that names the
/// fields, then `DATA ascii`, `binary` or `binary_compressed`, little-endian). Accepts these common
/// deviations: lower-case TYPE, COUNT 0, WIDTH and HEIGHT without POINTS, a byte order mark, blank
/// lines and comments among text. The file may have no points. Fails with kNotFound, kUnreadable,
/// kMalformed or kUnsupported; the message names the file, the line or the point, what was found
/// and what expected.
[[nodiscard]] Expected<FieldTable> read_pcd(const std::filesystem::path& path);
/// Parses a PCD file in memory; `name` stands for the path in messages.
[[nodiscard]] Expected<FieldTable> parse_pcd(std::string_view content, const std::string& name);

}  // namespace terracut::cloud
