// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/part_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "tests/support/child_process.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

class PartFile : public test::InScratchFolder {
 protected:
  void tidy_up(std::string_view place) const {
    remove_abandoned_parts(folder_, [&](std::string_view name) { return name == place; });
  }
};

TEST_F(PartFile, StaysWhileItsMakerLives) {
  const Part file = make_part_file(folder_ / "a");
  const Part folder = make_part_folder(folder_ / "a");
  ASSERT_TRUE(file.lock);
  ASSERT_TRUE(folder.lock);
  tidy_up("a");
  EXPECT_TRUE(fs::is_regular_file(file.path));
  EXPECT_TRUE(fs::is_directory(folder.path));
}

TEST_F(PartFile, OfADeadProcessIsRemovedWithWhatIsInIt) {
  ASSERT_EQ(test::in_child_process([&]() -> std::string {
              // Not closed before the process ends, like one that is killed.
              const auto* file = new Part(make_part_file(folder_ / "a"));
              const auto* folder = new Part(make_part_folder(folder_ / "a"));
              std::ofstream(folder->path / "inside") << "x";
              return file->lock && folder->lock ? "" : "not made";
            }),
            "");
  ASSERT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
  tidy_up("b");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "of another place";
  tidy_up("a");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(PartFile, IsToldFromOtherFilesByItsName) {
  for (const char* name : {"a.part-1", "a.part-x-1", "a.part-1-x", "a.part--1", "a"}) {
    std::ofstream(folder_ / name) << "mine";
  }
  remove_abandoned_parts(folder_, [](std::string_view) { return true; });
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 5);
}

TEST_F(PartFile, TakesAnotherNameWhereADeadProcessHadItsOwn) {
  const Part first = make_part_file(folder_ / "a");
  const Part second = make_part_file(folder_ / "a");
  EXPECT_NE(first.path, second.path);
}

TEST_F(PartFile, ThatCannotBeMadeSaysWhy) {
  const Part part = make_part_file(folder_ / "absent" / "a");
  EXPECT_FALSE(part.lock);
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace terracut::files
