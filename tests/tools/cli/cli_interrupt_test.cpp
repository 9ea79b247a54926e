// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Ctrl-C and SIGTERM, sent when a run is seen to be at work.
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include "background_program.hpp"
#include "cli_fixture.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

constexpr int kInterrupted = 9;

class CliInterrupt : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ::setenv("TMPDIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("TMPDIR");
    Cli::TearDown();
  }

  /// Starts the program, sends the signal once `is_at_work()`, and waits for its end.
  [[nodiscard]] Outcome interrupt(const std::string& arguments, int signal,
                                  const std::function<bool()>& is_at_work) const {
    BackgroundProgram program(folder_, "run", arguments);
    while (!is_at_work() && !program.has_ended()) std::this_thread::yield();
    program.interrupt(signal);
    Outcome outcome = program.end();
    fs::remove(folder_ / "run.stdout.txt");
    return outcome;
  }
  /// A part of a file or folder of that name is being written somewhere in the test's folder.
  [[nodiscard]] bool is_under_way(const std::string& name) const {
    std::error_code vanished;  // the program makes and removes files meanwhile
    fs::recursive_directory_iterator entry(folder_, vanished);
    for (; !vanished && entry != fs::recursive_directory_iterator(); entry.increment(vanished)) {
      if (entry->path().filename().string().starts_with(name + ".part-")) return true;
    }
    return false;
  }
};

TEST_F(CliInterrupt, OfASimulationLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome = interrupt("simulate --duration 3000 -o a.pcap", signal,
                                      [&] { return is_under_way("a.truth"); });
    EXPECT_EQ(outcome.exit_code, kInterrupted) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    EXPECT_TRUE(fs::is_empty(folder_));
  }
}

TEST_F(CliInterrupt, OfAReplayIsInItsReport) {
  const Outcome outcome =
      interrupt("replay " + quoted(kDrive) + " --loop 1000000 --labels labels --json r.json",
                SIGINT, [&] { return fs::exists(folder_ / "labels" / "000002.label"); });
  EXPECT_EQ(outcome.exit_code, kInterrupted) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("interrupted"));
  EXPECT_EQ(json("r.json")["interrupted"], true);
}

TEST_F(CliInterrupt, IsTheEndOfAReplayThatHasNoOther) {
  const Outcome outcome =
      interrupt("replay " + quoted(kDrive) + " --loop --labels labels --json r.json", SIGTERM,
                [&] { return fs::exists(folder_ / "labels" / "000002.label"); });
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json("r.json")["interrupted"], false);
}

TEST_F(CliInterrupt, OfAnEvaluationOfDrivesIsSaid) {
  const Outcome outcome = interrupt("eval simulated street --duration 3000 --json e.json", SIGINT,
                                    [&] { return is_under_way("drive.truth"); });
  EXPECT_EQ(outcome.exit_code, kInterrupted) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_EQ(json("e.json")["interrupted"], true);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "report and journal";
}

}  // namespace
}  // namespace terracut::cli
