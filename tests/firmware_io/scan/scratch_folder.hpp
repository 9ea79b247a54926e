// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/support/scratch_folder.hpp"

namespace terracut::scan {

/// An empty folder of the running test's own, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder() { path_ = test::make_scratch_folder(); }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::filesystem::path& name, std::string_view content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  template <class T>
  std::filesystem::path write_records(const std::filesystem::path& name, const T& records) const {
    return write(name, std::string_view(reinterpret_cast<const char*>(records.data()),
                                        records.size() * sizeof(records[0])));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace terracut::scan
