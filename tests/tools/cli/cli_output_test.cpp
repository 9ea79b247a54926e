// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Where messages and results go cannot be written, or is not there.
#include <unistd.h>

#include <array>

#include "cli_fixture.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

class CliOutput : public Cli {
 protected:
  /// Runs `terracut ARGUMENTS`, which redirect its output; returns the exit status, -1 of a signal.
  [[nodiscard]] int run_redirected(const std::string& arguments) const {
    const std::string command =
        "cd " + quoted(folder_) + " && exec " + quoted(test::program()) + " " + arguments;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(CliOutput, AFullDiskUnderTheMessagesEndsNothing) {
  EXPECT_EQ(run_redirected("replay " + quoted(kDrive) + " --labels labels >out.txt 2>/dev/full"),
            0);
  EXPECT_EQ(files_in(folder_ / "labels", ".label"), kDriveFrames);
}

TEST_F(CliOutput, AReaderOfTheMessagesThatHasGoneEndsNothing) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  ::close(ends[0]);
  EXPECT_EQ(run_redirected("replay " + quoted(kDrive) + " --labels labels >out.txt 2>&" +
                           std::to_string(ends[1])),
            0);
  ::close(ends[1]);
  EXPECT_EQ(files_in(folder_ / "labels", ".label"), kDriveFrames);
}

TEST_F(CliOutput, MessagesNeverGetIntoAFileWhereTheirDescriptorIsClosed) {
  EXPECT_EQ(run_redirected("replay " + quoted(kDrive) + " --labels labels >out.txt 2>&-"), 0);
  const Outcome usual = run("replay " + quoted(kDrive) + " --labels usual");
  for (const auto& file : fs::directory_iterator(folder_ / "usual")) {
    EXPECT_EQ(content_of(folder_ / "labels" / file.path().filename()), content_of(file.path()));
  }
}

TEST_F(CliOutput, ResultsThatCannotBeWrittenAreAnError) {
  EXPECT_EQ(run_redirected("info " + quoted(kDrive) + " >/dev/full 2>said.txt"), 4);
  EXPECT_THAT(content_of(folder_ / "said.txt"),
              HasSubstr("error: standard output: No space left on device"));
}

}  // namespace
}  // namespace terracut::cli
