// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/page/status_page_file.hpp"

namespace terracut::page {

/// A status page that was found.
struct StatusPageEntry {
  std::string name;
  std::int32_t pid = 0;     ///< Of its publisher.
  std::uint32_t owner = 0;  ///< User the file belongs to.
  bool publisher_lives = false;
};

/// All status pages of `folder`, of whatever layout, by name. What cannot be read, is none, or
/// could have been made by anybody (trusted_file.hpp), is left out. Reads the headers only; touches
/// neither pages nor locks.
[[nodiscard]] std::vector<StatusPageEntry> list_status_pages(
    const std::filesystem::path& folder = status_page_folder());

}  // namespace terracut::page
