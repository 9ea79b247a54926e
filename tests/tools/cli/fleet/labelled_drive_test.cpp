// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/fleet/labelled_drive.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

class LabelledDrive : public test::InScratchFolder {
 protected:
  /// A sealed folder of two label files.
  [[nodiscard]] fs::path sealed(const std::string& name, const std::string& content = "ground") {
    fs::create_directories(folder_ / name);
    write(name + "/000000.label", content);
    write(name + "/000001.label", content);
    EXPECT_TRUE(seal(folder_ / name, {{"drive", "d"}}));
    return folder_ / name;
  }
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

TEST_F(LabelledDrive, IsWholeWhateverItsFilesAreCalled) {
  const fs::path a = folder_ / "a";
  fs::create_directories(a);
  const std::string name = "line\nbreak \\n.label";
  write("a/" + name, "ground");
  ASSERT_TRUE(seal(a, {{"drive", "d"}}));
  EXPECT_FALSE(facts_of_whole(a).is_null());
  EXPECT_TRUE(listed_sums(a).contains(name));
  const std::string check = "cd '" + a.string() + "' && sha256sum --quiet -c SHA256SUMS";
  EXPECT_EQ(std::system(check.c_str()), 0);
}

TEST_F(LabelledDrive, IsNotWholeWithAFileCutShortOrGone) {
  write(sealed("short").filename().string() + "/000001.label", "gro");
  fs::remove(sealed("gone") / "000000.label");
  fs::remove(sealed("sums") / kDriveSums);
  fs::resize_file(sealed("cut") / kDriveSums, 100);
  fs::resize_file(sealed("facts") / kDriveFacts, 20);
  for (const char* const name : {"short", "gone", "sums", "cut", "facts", "nowhere"}) {
    EXPECT_TRUE(facts_of_whole(folder_ / name).is_null()) << name;
  }
}

TEST_F(LabelledDrive, IsWholeWithFilesOfOthersInIt) {
  const fs::path folder = sealed("a");
  write("a/notes.txt", "mine");
  write("a/.DS_Store", "");
  write("a/000007.label", "corrected by hand");
  fs::create_directory(folder / "@eaDir");
  EXPECT_FALSE(facts_of_whole(folder).is_null());
}

TEST_F(LabelledDrive, IsNotWholeWhereItsFactsAreNone) {
  for (const auto& [name, facts] : std::map<std::string, std::string>{
           {"text", R"({"files": 2, "bytes": 12, "frames": "x"})"},
           {"negative", R"({"files": 2, "bytes": 12, "frames": -1})"},
           {"losses", R"({"files": 2, "bytes": 12, "losses": {"a": [1]}})"},
           {"list", "[2, 12]"},
           {"deep", std::string(1'000'000, '[')},
           {"nothing", ""}}) {
    (void)sealed(name);
    write(name + "/terracut.json", facts);
    EXPECT_TRUE(facts_of_whole(folder_ / name).is_null()) << name;
  }
  for (const std::string_view file : {kDriveFacts, kDriveSums}) {
    const fs::path pipe = sealed("pipe") / file;
    fs::remove(pipe);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_TRUE(facts_of_whole(folder_ / "pipe").is_null()) << file;
  }
}

TEST_F(LabelledDrive, LeavesAWholeOneWhereItIs) {
  fs::create_directories(folder_ / "part1");
  fs::create_directories(folder_ / "part2");
  const fs::path first = sealed("part1/labels"), second = sealed("part2/labels");
  const fs::path place = folder_ / "deep/er/d-1";
  ASSERT_TRUE(put_in_place(first, place, folder_ / "broken"));
  const auto written = fs::last_write_time(place / "000000.label");
  ASSERT_TRUE(put_in_place(second, place, folder_ / "broken"));
  EXPECT_EQ(fs::last_write_time(place / "000000.label"), written);
  EXPECT_TRUE(fs::exists(second)) << "whoever comes second keeps its own, to throw it away";
}

TEST_F(LabelledDrive, TakesThePlaceOfABrokenOneAndKeepsThat) {
  fs::create_directories(folder_ / "part1");
  const fs::path broken = folder_ / "hidden/d-1", place = folder_ / "d-1";
  for (const char* const aside : {"hidden/d-1.1", "hidden/d-1.2"}) {
    (void)sealed("d-1", "broken");
    write("d-1/notes.txt", "mine");
    fs::remove(place / "000001.label");
    const auto kept = put_in_place(sealed("part1/labels"), place, broken);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(*kept, folder_ / aside);
    EXPECT_FALSE(facts_of_whole(place).is_null());
    EXPECT_TRUE(fs::exists(folder_ / aside / "notes.txt"));
    fs::remove_all(place);
  }
}

TEST_F(LabelledDrive, TakesNoPlaceOfAFileALinkOrANameThatCannotBe) {
  write("file", "mine");
  fs::create_symlink("moved/away", folder_ / "link");
  for (const fs::path& place : {folder_ / "file", folder_ / "link", folder_ / "file/below",
                                folder_ / std::string(256, 'x')}) {
    const Status free = check_place(place);
    ASSERT_FALSE(free) << place;
    EXPECT_EQ(free.error().code, ErrorCode::kInvalidArgument) << "of this place alone";
    EXPECT_FALSE(put_in_place(sealed("labels"), place, folder_ / "broken")) << place;
  }
  EXPECT_TRUE(check_place(folder_ / "deep/er/d-1"));
  EXPECT_FALSE(fs::exists(folder_ / "deep/er/d-1")) << "it was only looked at";
}

TEST_F(LabelledDrive, MayHaveBeenMovedAndLinkedTo) {
  fs::create_directory_symlink(sealed("archived"), folder_ / "d-1");
  EXPECT_TRUE(check_place(folder_ / "d-1"));
  EXPECT_TRUE(put_in_place(sealed("labels"), folder_ / "d-1", folder_ / "broken"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "d-1"));
}

}  // namespace
}  // namespace terracut::cli
