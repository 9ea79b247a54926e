// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/fleet/labelled_drive.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

class LabelledDrive : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::make_scratch_folder(); }
  void TearDown() override { fs::remove_all(folder_); }

  /// A sealed folder of two label files.
  [[nodiscard]] fs::path sealed(const std::string& name, const std::string& content = "ground") {
    fs::create_directories(folder_ / name);
    write(name + "/000000.label", content);
    write(name + "/000001.label", content);
    EXPECT_TRUE(seal(folder_ / name, {{"drive", "d"}}));
    return folder_ / name;
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }

  fs::path folder_;
};

TEST_F(LabelledDrive, IsWholeOnceItIsSealed) {
  fs::create_directories(folder_ / "a");
  write("a/000000.label", "ground");
  EXPECT_TRUE(facts_of_whole(folder_ / "a").is_null());
  ASSERT_TRUE(seal(folder_ / "a", {{"drive", "d"}}));
  const auto facts = facts_of_whole(folder_ / "a");
  EXPECT_EQ(facts["drive"], "d");
  EXPECT_EQ(facts["files"], 1);
  EXPECT_EQ(facts["bytes"], 6);
}

TEST_F(LabelledDrive, HasSumsThatSha256sumTakes) {
  const fs::path a = sealed("a");
  const std::string check =
      "cd '" + a.string() + "' && sha256sum --quiet -c SHA256SUMS 2>/dev/null";
  EXPECT_EQ(std::system(check.c_str()), 0);
  write("a/000001.label", "Ground");
  EXPECT_NE(std::system(check.c_str()), 0) << "a bit has changed";
}

TEST_F(LabelledDrive, IsNotWholeWithAFileCutShortOrGoneOrOneTooMany) {
  write(sealed("short").filename().string() + "/000001.label", "gro");
  fs::remove(sealed("gone") / "000000.label");
  (void)sealed("more");
  write("more/000002.label", "");
  fs::remove(sealed("sums") / kDriveSums);
  fs::resize_file(sealed("cut") / kDriveSums, 100);
  fs::resize_file(sealed("facts") / kDriveFacts, 20);
  for (const char* const name : {"short", "gone", "more", "sums", "cut", "facts", "nowhere"}) {
    EXPECT_TRUE(facts_of_whole(folder_ / name).is_null()) << name;
  }
}

TEST_F(LabelledDrive, LeavesAWholeOneWhereItIs) {
  fs::create_directories(folder_ / "part1");
  fs::create_directories(folder_ / "part2");
  const fs::path first = sealed("part1/labels"), second = sealed("part2/labels");
  const fs::path place = folder_ / "deep/er/d-1";
  ASSERT_TRUE(put_in_place(first, place));
  const auto written = fs::last_write_time(place / "000000.label");
  ASSERT_TRUE(put_in_place(second, place));
  EXPECT_EQ(fs::last_write_time(place / "000000.label"), written);
  EXPECT_TRUE(fs::exists(second)) << "whoever comes second keeps its own, to throw it away";
}

TEST_F(LabelledDrive, TakesThePlaceOfABrokenOne) {
  fs::create_directories(folder_ / "part1");
  const fs::path place = sealed("d-1", "broken");
  fs::remove(place / "000001.label");
  ASSERT_TRUE(put_in_place(sealed("part1/labels"), place));
  EXPECT_FALSE(facts_of_whole(place).is_null());
  EXPECT_TRUE(fs::exists(folder_ / "part1/broken0"));
}

}  // namespace
}  // namespace terracut::cli
