// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/room_left.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_disk.hpp"

namespace terracut::files {
namespace {

TEST(RoomLeft, IsATenthOfADiskAndAGibibyteAtMost) {
  EXPECT_EQ(room_for_others(1'000), 100U);
  EXPECT_EQ(room_for_others(std::uint64_t{1} << 40), std::uint64_t{1} << 30);
}

TEST(RoomLeft, IsThatOfTheDiskThatAMissingFolderWillLieOn) {
  const test::ScratchFolder folder;
  EXPECT_TRUE(check_room_left(folder / "not" / "yet" / "there"));
  EXPECT_TRUE(check_room_left("not-there-either"));
}

TEST(RoomLeft, EndsBeforeTheDiskIsFull) {
  const test::ScratchFolder folder;
  const auto outcome = test::on_a_disk_of(1000, folder.path(), [&] {
    const auto grow_to = [&](std::size_t bytes) {
      std::ofstream(folder / "recording") << std::string(bytes, 'x');
    };
    grow_to(850'000);
    if (!check_room_left(folder / "recording")) return test::InChild::kOtherwise;
    grow_to(950'000);
    const Status status = check_room_left(folder / "recording");
    const bool says_so =
        !status && status.error().message.find("leave 102400 to others") != std::string::npos;
    return says_so ? test::InChild::kAsExpected : test::InChild::kOtherwise;
  });
  if (outcome == test::InChild::kNotPossible) GTEST_SKIP() << "no file system may be mounted here";
  EXPECT_EQ(outcome, test::InChild::kAsExpected);
}

}  // namespace
}  // namespace terracut::files
