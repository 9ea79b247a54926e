// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "rt/error.hpp"
#include "tests/support/places.hpp"

namespace terracut::calib {

/// An empty folder of this test's own, removed afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::random_device random;
    path_ = std::filesystem::temp_directory_path() /
            ("terracut-calib-" + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_),
                                                  std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}
inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// `text` with the first `from` replaced by `to`; fails the test if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "\"" << from << "\" is not in the text";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// EXPECT_THAT(result, IsRefusedWith(ErrorCode::kMalformed, HasSubstr("laser 5")))
template <class Matcher>
auto IsRefusedWith(ErrorCode code, const Matcher& message) {
  return testing::Truly([code, message](const auto& result) {
    if (result.has_value()) return false;
    const bool fits =
        result.error().code == code && testing::Matches(message)(result.error().message);
    EXPECT_TRUE(fits) << to_string(result.error().code) << ": " << result.error().message;
    return fits;
  });
}

}  // namespace terracut::calib
