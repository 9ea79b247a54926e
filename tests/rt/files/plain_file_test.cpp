// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/plain_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

class PlainFiles : public test::InScratchFolder {
 protected:
  [[nodiscard]] Expected<std::string> read(const fs::path& path) const {
    return read_plain_file(path, 100'000);
  }
};

TEST_F(PlainFiles, AreReadWholeAlsoByALink) {
  const std::string text(100'000, 'x');
  std::ofstream(folder_ / "a") << text;
  fs::create_symlink("a", folder_ / "link");
  EXPECT_EQ(read(folder_ / "a").value_or(""), text);
  EXPECT_EQ(read(folder_ / "link").value_or(""), text);
}

TEST_F(PlainFiles, AreNoLongerThanIsExpected) {
  std::ofstream(folder_ / "a") << std::string(100'001, 'x');
  EXPECT_EQ(read(folder_ / "a").error().code, ErrorCode::kUnreadable);
}

TEST_F(PlainFiles, AreNeitherPipesNorDevicesNorFolders) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const fs::path& path : {folder_ / "pipe", fs::path("/dev/zero"), folder_}) {
    EXPECT_EQ(read(path).error().code, ErrorCode::kUnreadable) << path;
  }
  EXPECT_EQ(read(folder_ / "nowhere").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace terracut::files
