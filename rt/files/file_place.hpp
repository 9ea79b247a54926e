// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <utility>

namespace terracut::files {

/// The place a path leads to, to tell whether two names mean one file or folder: relative paths,
/// symbolic and hard links and mounts are resolved. A path that does not exist yet is known by the
/// folder it would lie in. A snapshot: later changes of the disk are not seen.
class FilePlace {
 public:
  explicit FilePlace(const std::filesystem::path& path);

  [[nodiscard]] bool is_same_as(const FilePlace& other) const;
  /// True at any depth below `folder`, false for the folder itself.
  [[nodiscard]] bool lies_in(const FilePlace& folder) const;
  /// Returns the absolute path; links are resolved as far as the path exists.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<std::pair<::dev_t, ::ino_t>> file_;  ///< Empty if nothing exists there.
};

}  // namespace terracut::files
