// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/file_place.hpp"

#include <sys/stat.h>

#include <system_error>

namespace terracut::files {

namespace fs = std::filesystem;

FilePlace::FilePlace(const fs::path& path) {
  std::error_code error;
  path_ = fs::absolute(path, error);  // first: weakly_canonical() leaves a missing path relative
  if (fs::path canonical = fs::weakly_canonical(path_, error); !error) path_ = canonical;
  path_ = path_.lexically_normal();
  if (!path_.has_filename() && path_ != path_.root_path()) path_ = path_.parent_path();
  struct stat status{};
  if (::stat(path.c_str(), &status) == 0) file_.emplace(status.st_dev, status.st_ino);
}

bool FilePlace::is_same_as(const FilePlace& other) const {
  if (file_ && other.file_) return file_ == other.file_;
  return path_ == other.path_;
}

bool FilePlace::lies_in(const FilePlace& folder) const {
  for (fs::path at = path_; at != at.parent_path();) {
    at = at.parent_path();
    if (FilePlace(at).is_same_as(folder)) return true;
  }
  return false;
}

}  // namespace terracut::files
