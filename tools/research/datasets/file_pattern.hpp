// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terracut::datasets {

/// The files or folders in a folder whose names differ in one part: "velodyne/*.bin".
class FilePattern {
 public:
  FilePattern() = default;
  /// Returns nothing unless `text` is a relative path with exactly one `*`, in its last part.
  [[nodiscard]] static std::optional<FilePattern> parse(std::string_view text);

  /// Returns the parsed text.
  [[nodiscard]] std::string text() const { return path("*").string(); }
  /// Returns the path with `name` in place of the `*`.
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_ / (before_ + name + after_);
  }
  /// Returns what the `*` stands for in every matching entry of `root`, sorted; nothing if there is
  /// no such folder.
  [[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& root) const;

 private:
  std::filesystem::path folder_;
  std::string before_, after_;
};

}  // namespace terracut::datasets
