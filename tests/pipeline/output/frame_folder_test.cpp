// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/frame_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace terracut::output {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class FrameFolders : public test::InScratchFolder {
 protected:
  [[nodiscard]] FrameFolder folder_of(const std::string& input,
                                      const std::string& ending = ".label") {
    return FrameFolder({.folder = folder_,
                        .ending = ending,
                        .made_of = input,
                        .on_replaced = [this](std::size_t files) { replaced_ += files; }});
  }
  /// A run that writes so many frames of an input.
  void run(int frames, const std::string& ending = ".label", const std::string& input = "/a.pcap") {
    FrameFolder folder = folder_of(input, ending);
    ASSERT_TRUE(folder.check());
    for (int i = 0; i < frames; ++i) {
      const auto path = folder.place(std::to_string(i) + ending);
      ASSERT_TRUE(path) << path.error().message;
      std::ofstream(*path) << "run";
    }
  }
  void expect_refused(const FrameFolder& folder, ErrorCode code, const std::string& said) {
    const Status refused = folder.check();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, code);
    EXPECT_THAT(refused.error().message, testing::HasSubstr(said));
  }
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with('.')) names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
  }
  std::size_t replaced_ = 0;  ///< Files, as runs were told.
};

TEST_F(FrameFolders, HoldTheFilesOfOneRun) {
  run(3);
  EXPECT_THAT(files(), ElementsAre("0.label", "1.label", "2.label"));
  EXPECT_EQ(replaced_, 0u);
  run(2);
  EXPECT_THAT(files(), ElementsAre("0.label", "1.label"));
  EXPECT_EQ(replaced_, 3u);
}

TEST_F(FrameFolders, OfAnotherInputAreKeptUnlessTheyMayGo) {
  run(3);
  FrameFolder other = folder_of("/b.pcap");
  expect_refused(other, ErrorCode::kInvalidArgument,
                 "3 .label files in it that were made of /a.pcap");
  EXPECT_FALSE(other.place("0.label")) << "whoever did not ask before";
  EXPECT_THAT(files(), ElementsAre("0.label", "1.label", "2.label"));
  run(1, ".pcd", "/b.pcap");

  FrameFolder overwrites({.folder = folder_,
                          .ending = ".label",
                          .made_of = "/b.pcap",
                          .replaces_others = true,
                          .on_replaced = [this](std::size_t files) { replaced_ += files; }});
  ASSERT_TRUE(overwrites.check());
  std::ofstream(overwrites.place("7.label").value()) << "run";
  EXPECT_EQ(replaced_, 3u);
  EXPECT_THAT(files(), ElementsAre("0.pcd", "7.label"));
  EXPECT_FALSE(folder_of("/a.pcap").check());
}

TEST_F(FrameFolders, OfAnotherInputWhoseFilesAreGoneAreFree) {
  run(1);
  fs::remove(folder_ / "0.label");
  run(1, ".label", "/b.pcap");
  EXPECT_FALSE(folder_of("/a.pcap").check());
}

TEST_F(FrameFolders, OfAnEarlierVersionDoNotSayWhatTheyWereMadeOf) {
  std::ofstream(folder_ / ".label.terracut") << "5.label\n";
  std::ofstream(folder_ / "5.label") << "run";
  run(1);
  EXPECT_THAT(files(), ElementsAre("0.label"));
  EXPECT_EQ(replaced_, 1u);
}

TEST_F(FrameFolders, KnowTheirFilesWhateverTheirNamesHold) {
  for (int pass = 0; pass < 2; ++pass) {
    FrameFolder folder = folder_of("/a\nb.label");
    ASSERT_TRUE(folder.check());
    std::ofstream(folder.place("a\nb.label").value()) << "run";
  }
  std::ofstream(folder_ / "b.label") << "mine";
  EXPECT_FALSE(folder_of("/a\nb.label").check());
}

TEST_F(FrameFolders, WaitForNoPipeInTheListsPlaceAndWriteThroughNoLink) {
  const fs::path list = folder_ / ".label.terracut";
  ASSERT_EQ(::mkfifo(list.c_str(), 0600), 0);
  expect_refused(folder_of("/a.pcap"), ErrorCode::kUnreadable, "a pipe");
  fs::remove(list);
  const fs::path mine = folder_ / "mine.txt";
  std::ofstream(mine) << "mine\n";
  fs::create_symlink(mine, list);
  EXPECT_FALSE(folder_of("/a.pcap").place("0.label"));
  EXPECT_EQ(fs::file_size(mine), 5u);
}

TEST_F(FrameFolders, KeepTheFilesOfARunUntilTheNextHasOne) {
  run(3);
  run(0);
  EXPECT_THAT(files(), ElementsAre("0.label", "1.label", "2.label"));
}

TEST_F(FrameFolders, KeepWhatIsNotTheRuns) {
  run(2, ".pcd");
  std::ofstream(folder_ / "notes.txt") << "mine";
  run(2);
  run(1);
  EXPECT_THAT(files(), ElementsAre("0.label", "0.pcd", "1.pcd", "notes.txt"));
}

TEST_F(FrameFolders, WithFilesOfAnotherOriginAreRefused) {
  std::ofstream(folder_ / "000007.label") << "truth";
  std::ofstream(folder_ / "000003.label") << "truth";
  const FrameFolder folder = folder_of("/a.pcap");
  expect_refused(folder, ErrorCode::kInvalidArgument, "there are 2 .label files in it");
  expect_refused(folder, ErrorCode::kInvalidArgument, "000003.label");
  EXPECT_TRUE(folder_of("/a.pcap", ".pcd").check());
}

TEST_F(FrameFolders, WithFilesOfAnotherOriginBesideARunsAreRefused) {
  run(1);
  std::ofstream(folder_ / "000003.label") << "truth";
  EXPECT_FALSE(folder_of("/a.pcap").check());
}

TEST_F(FrameFolders, RemoveNothingThatAListCannotHaveFromThem) {
  std::ofstream(folder_ / "0.pcd") << "mine";
  fs::create_directory(folder_ / "below");
  std::ofstream(folder_ / "below" / "0.label") << "mine";
  std::ofstream(folder_ / ".label.terracut") << "0.pcd\nbelow/0.label\n../x.label\ntorn.label";
  std::ofstream(folder_ / "torn.label") << "mine";
  EXPECT_FALSE(folder_of("/a.pcap").check()) << "a torn line lists nothing";
  fs::remove(folder_ / "torn.label");
  run(1);
  EXPECT_TRUE(fs::exists(folder_ / "0.pcd"));
  EXPECT_TRUE(fs::exists(folder_ / "below" / "0.label"));
}

TEST_F(FrameFolders, ThatWereReplacedDuringTheRunGetNoMoreFiles) {
  const fs::path labels = folder_ / "labels", truth = folder_ / "truth";
  FrameFolder folder({.folder = labels, .ending = ".label"});
  std::ofstream(folder.place("0.label").value()) << "run";
  fs::create_directory(truth);
  fs::rename(labels, folder_ / "aside");
  fs::create_directory_symlink(truth, labels);
  const auto refused = folder.place("1.label");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kWriteFailed);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("replaced while the run wrote to it"));
  fs::remove(labels);
  fs::rename(folder_ / "aside", labels);
  EXPECT_TRUE(folder.place("1.label")) << "it is back";
}

TEST_F(FrameFolders, OfAKilledRunAreReplacedByTheNext) {
  {
    FrameFolder killed = folder_of("/a.pcap");
    for (const char* name : {"0.label", "1.label"}) {
      const auto path = killed.place(name);
      ASSERT_TRUE(path);
      std::ofstream(*path) << "run";
    }
  }
  ASSERT_TRUE(fs::remove(folder_ / "1.label")) << "listed, but not written before it was killed";
  run(1);
  EXPECT_THAT(files(), ElementsAre("0.label"));
}

}  // namespace
}  // namespace terracut::output
