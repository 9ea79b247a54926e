// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <utility>

namespace terracut::files {

/// Identifies the file or folder that a path leads to, so that two names for the same one are
/// recognised: relative paths, symbolic and hard links and mounts are resolved. A path that does
/// not exist yet is identified by its folder and name. Later changes of the disk are not seen.
class FilePlace {
 public:
  explicit FilePlace(const std::filesystem::path& path);

  [[nodiscard]] bool is_same_as(const FilePlace& other) const;
  /// True if this place lies below `folder`, at any depth; false for `folder` itself.
  [[nodiscard]] bool lies_in(const FilePlace& folder) const;
  /// Returns the absolute path; links are resolved as far as the path exists.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  /// Device and inode; empty if nothing exists at the path.
  std::optional<std::pair<::dev_t, ::ino_t>> file_;
};

}  // namespace terracut::files
