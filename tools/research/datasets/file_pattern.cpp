// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "file_pattern.hpp"

#include <algorithm>
#include <ranges>
#include <system_error>

namespace terracut::datasets {

namespace fs = std::filesystem;

std::optional<FilePattern> FilePattern::parse(std::string_view text) {
  const fs::path path(text);
  const std::string last = path.filename().string();
  const std::size_t star = last.find('*');
  if (path.is_absolute() || std::ranges::count(text, '*') != 1 || star == std::string::npos) {
    return std::nullopt;
  }
  FilePattern pattern;
  pattern.folder_ = path.parent_path();
  pattern.before_ = last.substr(0, star);
  pattern.after_ = last.substr(star + 1);
  return pattern;
}

std::vector<std::string> FilePattern::names_in(const fs::path& root) const {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(root / folder_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() > before_.size() + after_.size() && name.starts_with(before_) &&
        name.ends_with(after_)) {
      names.push_back(name.substr(before_.size(), name.size() - before_.size() - after_.size()));
    }
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace terracut::datasets
