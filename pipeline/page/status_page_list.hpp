// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/page/status_page_file.hpp"

namespace terracut::page {

/// A status page found in a folder.
struct StatusPageEntry {
  std::string name;
  std::int32_t pid = 0;     ///< Process number of the page's publisher.
  std::uint32_t owner = 0;  ///< The user that owns the file.
  bool publisher_lives = false;
};

/// Lists all status pages of `folder`, of any layout, by name. Leaves out files that cannot be
/// read, that are no page, or that anybody could have made (trusted_file.hpp). Reads only the
/// pages' headers; touches neither values nor locks.
[[nodiscard]] std::vector<StatusPageEntry> list_status_pages(
    const std::filesystem::path& folder = status_page_folder());

}  // namespace terracut::page
