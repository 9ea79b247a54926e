// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace terracut::test {

[[nodiscard]] inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

/// An empty folder of the running test alone, removed with all that is in it at the end.
class ScratchFolder {
 public:
  /// Of this process too, so that two builds can be tested at once.
  ScratchFolder() {
    static int made = 0;
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("terracut_") + info->test_suite_name() + "_" + info->name() +
                       "_" + std::to_string(::getpid()) + "_" + std::to_string(made++);
    std::ranges::replace(name, '/', '_');  // parameterised tests
    path_ = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
    path_ = std::filesystem::canonical(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// How many files and folders are in it.
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

  /// A file of that content, and the folders that it lies in.
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

/// A test with a folder of its own.
class InScratchFolder : public testing::Test {
 protected:
  void write(const std::filesystem::path& name, std::string_view content) const {
    (void)scratch_.write(name, content);
  }

 private:
  const ScratchFolder scratch_;

 protected:
  const std::filesystem::path folder_ = scratch_.path();
};

}  // namespace terracut::test
