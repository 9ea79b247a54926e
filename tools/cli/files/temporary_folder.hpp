// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

#include "rt/files/part_file.hpp"

namespace terracut::cli {

/// A folder that the destructor removes with its content. Folders that killed processes left are
/// removed, too.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    if (error) return;
    constexpr std::string_view kName = "terracut";
    files::remove_abandoned_parts(folder, [&](std::string_view name) { return name == kName; });
    part_ = files::make_part_folder(folder / kName);
    if (!part_.lock) part_.path.clear();
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code gone_or_not;
    if (!path().empty()) std::filesystem::remove_all(path(), gone_or_not);
  }
  /// Returns the folder's path; empty if none could be made.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return part_.path; }

 private:
  files::Part part_;
};

}  // namespace terracut::cli
