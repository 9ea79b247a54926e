// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/whole_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace terracut::files {
namespace {

namespace fs = std::filesystem;
using test::content_of;

class WholeFile : public test::InScratchFolder {
 protected:
  [[nodiscard]] static std::ptrdiff_t files_in(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  }
};

TEST_F(WholeFile, WritesContentAndLeavesNoTemporaryFile) {
  ASSERT_TRUE(write_whole_file(folder_ / "a.txt", "hello").has_value());
  EXPECT_EQ(content_of(folder_ / "a.txt"), "hello");
  EXPECT_EQ(files_in(folder_), 1);
}

TEST_F(WholeFile, ReplacesAnOlderFile) {
  ASSERT_TRUE(write_whole_file(folder_ / "a.txt", "a long old content").has_value());
  ASSERT_TRUE(write_whole_file(folder_ / "a.txt", "new").has_value());
  EXPECT_EQ(content_of(folder_ / "a.txt"), "new");
}

TEST_F(WholeFile, MakesMissingFolders) {
  ASSERT_TRUE(write_whole_file(folder_ / "x" / "y" / "a.txt", "deep").has_value());
  EXPECT_EQ(content_of(folder_ / "x" / "y" / "a.txt"), "deep");
}

TEST_F(WholeFile, WritesWhatComesPieceByPiece) {
  std::vector<std::string_view> pieces{"", "three", "two", "one "};
  const auto next = [&]() -> Expected<std::string_view> {
    const std::string_view piece = pieces.back();
    pieces.pop_back();
    return piece;
  };
  ASSERT_TRUE(write_whole_file(folder_ / "a.txt", next).has_value());
  EXPECT_EQ(content_of(folder_ / "a.txt"), "one twothree");
}

TEST_F(WholeFile, LeavesAllAsItWasWhereAPieceCannotBeHad) {
  ASSERT_TRUE(write_whole_file(folder_ / "a.txt", "old").has_value());
  bool first = true;
  const auto next = [&]() -> Expected<std::string_view> {
    if (!std::exchange(first, false)) return fail(ErrorCode::kMalformed, "no more");
    return "new";
  };
  const Status status = write_whole_file(folder_ / "a.txt", next);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().message, "no more");
  EXPECT_EQ(content_of(folder_ / "a.txt"), "old");
  EXPECT_EQ(files_in(folder_), 1);
}

TEST_F(WholeFile, SaysWhichFileAndWhyWhenAFolderIsAFile) {
  ASSERT_TRUE(write_whole_file(folder_ / "file", "x").has_value());
  const Status status = write_whole_file(folder_ / "file" / "a.txt", "x");
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::kWriteFailed);
  EXPECT_THAT(status.error().message, testing::HasSubstr("a.txt"));
}

TEST_F(WholeFile, LeavesNothingBehindWhenItCannotTakeItsPlace) {
  fs::create_directories(folder_ / "taken" / "inside");  // a folder that is not empty
  const Status status = write_whole_file(folder_ / "taken", "x");
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::kWriteFailed);
  EXPECT_EQ(files_in(folder_), 1);
  EXPECT_TRUE(fs::is_directory(folder_ / "taken" / "inside"));
}

}  // namespace
}  // namespace terracut::files
