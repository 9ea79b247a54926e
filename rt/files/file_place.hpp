// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <utility>

namespace terracut::files {

/// Where a path leads, so that two names of one file or folder are told to be one: relative paths,
/// symbolic and hard links and mounts are seen through. What is not there yet is known by the
/// folder it would lie in. A snapshot: later changes of the disk are not seen.
class FilePlace {
 public:
  explicit FilePlace(const std::filesystem::path& path);

  [[nodiscard]] bool is_same_as(const FilePlace& other) const;
  /// At any depth below `folder`; not the folder itself.
  [[nodiscard]] bool lies_in(const FilePlace& folder) const;
  /// Absolute, without links as far as it exists.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<std::pair<::dev_t, ::ino_t>> file_;  ///< None: there is nothing there.
};

}  // namespace terracut::files
