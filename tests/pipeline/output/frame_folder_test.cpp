// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/frame_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

class FrameFolders : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::make_scratch_folder(); }
  void TearDown() override { fs::remove_all(folder_); }

  /// A run that writes so many frames.
  void run(int frames, const std::string& ending = ".label") const {
    FrameFolder folder(folder_, ending);
    ASSERT_TRUE(folder.check());
    for (int i = 0; i < frames; ++i) {
      const auto path = folder.place(std::to_string(i) + ending);
      ASSERT_TRUE(path) << path.error().message;
      std::ofstream(*path) << "run";
    }
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
  fs::path folder_;
};

TEST_F(FrameFolders, HoldTheFilesOfOneRun) {
  run(3);
  EXPECT_THAT(files(), ElementsAre("0.label", "1.label", "2.label"));
  run(2);
  EXPECT_THAT(files(), ElementsAre("0.label", "1.label"));
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
  const Status refused = FrameFolder(folder_, ".label").check();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("there are 2 .label files in it"));
  EXPECT_THAT(refused.error().message, testing::HasSubstr("000003.label"));
  EXPECT_TRUE(FrameFolder(folder_, ".pcd").check());
}

TEST_F(FrameFolders, WithFilesOfAnotherOriginBesideARunsAreRefused) {
  run(1);
  std::ofstream(folder_ / "000003.label") << "truth";
  EXPECT_FALSE(FrameFolder(folder_, ".label").check());
}

TEST_F(FrameFolders, RemoveNothingThatAListCannotHaveFromThem) {
  std::ofstream(folder_ / "0.pcd") << "mine";
  fs::create_directory(folder_ / "below");
  std::ofstream(folder_ / "below" / "0.label") << "mine";
  std::ofstream(folder_ / ".label.terracut") << "0.pcd\nbelow/0.label\n../x.label\ntorn.label";
  std::ofstream(folder_ / "torn.label") << "mine";
  EXPECT_FALSE(FrameFolder(folder_, ".label").check()) << "a torn line lists nothing";
  fs::remove(folder_ / "torn.label");
  run(1);
  EXPECT_TRUE(fs::exists(folder_ / "0.pcd"));
  EXPECT_TRUE(fs::exists(folder_ / "below" / "0.label"));
}

TEST_F(FrameFolders, OfAKilledRunAreReplacedByTheNext) {
  {
    FrameFolder killed(folder_, ".label");
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
