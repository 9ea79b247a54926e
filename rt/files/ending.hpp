// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace terracut::files {

/// Returns the ending in lower case: ".pcd" for a.pcd and for A.PCD; empty if the name has none.
[[nodiscard]] inline std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return ending;
}

}  // namespace terracut::files
