// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "rt/error.hpp"
#include "rt/files/part_file.hpp"

namespace terracut::bag {

/// A file in the folder for temporary files, removed with this object.
class TemporaryFile {
 public:
  /// Fails with kWriteFailed.
  [[nodiscard]] static Expected<TemporaryFile> make() {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    files::Part part;
    if (!error) part = files::make_part_file(folder / "terracut-bag");
    if (part.lock) return TemporaryFile(std::move(part));
    if (!error) error.assign(errno, std::generic_category());
    return fail(ErrorCode::kWriteFailed, "the folder for temporary files: " + error.message());
  }
  TemporaryFile(TemporaryFile&& other) noexcept
      : part_{std::exchange(other.part_.path, {}), std::move(other.part_.lock)} {}
  TemporaryFile& operator=(TemporaryFile&& other) noexcept {
    std::swap(part_.path, other.part_.path);
    std::swap(part_.lock, other.part_.lock);
    return *this;
  }
  ~TemporaryFile() {
    std::error_code gone_or_not;
    if (!part_.path.empty()) std::filesystem::remove(part_.path, gone_or_not);
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return part_.path; }
  [[nodiscard]] int descriptor() const noexcept { return part_.lock.get(); }

 private:
  explicit TemporaryFile(files::Part part) : part_(std::move(part)) {}
  files::Part part_;
};

}  // namespace terracut::bag
