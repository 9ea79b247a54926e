// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/output_claim.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

class OutputClaims : public test::InScratchFolder {
 protected:
  static std::optional<ErrorCode> refusal(const Expected<OutputClaim>& claim) {
    return claim ? std::nullopt : std::optional(claim.error().code);
  }
};

TEST_F(OutputClaims, OfAFileIsOneRunsAloneAndLeavesNothing) {
  {
    const auto claim = OutputClaim::of_file(folder_ / "r.json");
    ASSERT_TRUE(claim) << claim.error().message;
    const auto second = OutputClaim::of_file(folder_ / "r.json");
    EXPECT_EQ(refusal(second), ErrorCode::kInvalidArgument);
    EXPECT_THAT(second.error().message, testing::HasSubstr("r.json: another run is writing it"));
    EXPECT_TRUE(OutputClaim::of_file(folder_ / "other.json"));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  EXPECT_TRUE(OutputClaim::of_file(folder_ / "r.json"));
}

TEST_F(OutputClaims, OfAFolderIsOneRunsAloneUnlessItIsShared) {
  const fs::path labels = folder_ / "labels";
  {
    const auto claim = OutputClaim::of_folder(labels);
    ASSERT_TRUE(claim) << claim.error().message;
    EXPECT_EQ(refusal(OutputClaim::of_folder(labels)), ErrorCode::kInvalidArgument);
    EXPECT_EQ(refusal(OutputClaim::of_folder(labels, OutputClaim::Use::kShared)),
              ErrorCode::kInvalidArgument);
  }
  const auto one = OutputClaim::of_folder(labels, OutputClaim::Use::kShared);
  EXPECT_TRUE(OutputClaim::of_folder(labels, OutputClaim::Use::kShared));
  EXPECT_EQ(refusal(OutputClaim::of_folder(labels)), ErrorCode::kInvalidArgument);
}

TEST_F(OutputClaims, OfAnotherProcessHoldAndEndWithItHoweverItEnds) {
  const fs::path file = folder_ / "r.json", labels = folder_ / "labels";
  ASSERT_EQ(test::in_child_process([&]() -> std::string {
              const auto* of_file = new Expected<OutputClaim>(OutputClaim::of_file(file));
              const auto* of_folder = new Expected<OutputClaim>(OutputClaim::of_folder(labels));
              if (!*of_file || !*of_folder) return "not claimed";
              return test::in_child_process([&]() -> std::string {
                return OutputClaim::of_file(file) || OutputClaim::of_folder(labels)
                           ? "claimed twice"
                           : "";
              });
            }),
            "");
  EXPECT_TRUE(OutputClaim::of_file(file)) << "its lock file is still there, but nobody's";
  EXPECT_TRUE(OutputClaim::of_folder(labels));
}

TEST_F(OutputClaims, MakeMissingFoldersAndTakeAwayThoseThatStayEmpty) {
  {
    const auto file = OutputClaim::of_file(folder_ / "a" / "b" / "r.json");
    const auto labels = OutputClaim::of_folder(folder_ / "a" / "labels");
    ASSERT_TRUE(file && labels);
    EXPECT_TRUE(fs::is_directory(folder_ / "a" / "labels"));
    std::ofstream(folder_ / "a" / "labels" / "000000.label") << "x";
  }
  EXPECT_FALSE(fs::exists(folder_ / "a" / "b"));
  EXPECT_TRUE(fs::exists(folder_ / "a" / "labels" / "000000.label"));
}

TEST_F(OutputClaims, SayWhatStandsInTheWayOfWriting) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_EQ(refusal(OutputClaim::of_file(folder_ / "file" / "r.json")), ErrorCode::kWriteFailed);
  EXPECT_EQ(refusal(OutputClaim::of_folder(folder_ / "file")), ErrorCode::kWriteFailed);
  EXPECT_EQ(test::in_child_process([&]() -> std::string {
              fs::permissions(folder_, fs::perms{0555});
              if (!test::give_up_rights()) return "";
              const auto file = OutputClaim::of_file(folder_ / "r.json");
              const auto labels = OutputClaim::of_folder(folder_);
              const auto below = OutputClaim::of_folder(folder_ / "labels");
              return file || labels || below ? "claimed what cannot be written" : "";
            }),
            "");
  fs::permissions(folder_, fs::perms{0755});
}

}  // namespace
}  // namespace terracut::files
