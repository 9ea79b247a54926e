// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The same with more of everything; for ./tools/test --all.
#include <csignal>
#include <iostream>
#include <random>
#include <thread>

#include "relabel_fixture.hpp"
#include "tests/tools/cli/background_program.hpp"

namespace terracut::cli {
namespace {

class RelabelAtLength : public Relabel {};

TEST_F(RelabelAtLength, GoesOnAfterFiftyKills) {
  for (const char* const name : {"a", "b", "c", "d"}) add_drive(name);
  make_manifest();
  std::mt19937 random(19);
  int killed = 0;
  for (int i = 0; i < 50; ++i) {
    if (i % 5 == 0) fs::remove_all(folder_ / "out");
    // A moment is so many looks at the folder from the start; a run lasts some 300,000 of them.
    int looks = std::uniform_int_distribution(0, 200'000)(random);
    BackgroundProgram program(folder_, "run", "relabel m.json -o out");
    while (looks-- > 0 && !program.has_ended()) (void)fs::exists(folder_ / "out");
    program.interrupt(SIGKILL);
    if (program.end().exit_code != 0) ++killed;
    if (fs::exists(folder_ / "out")) expect_outputs_whole();
  }
  std::cout << killed << " of 50 were killed at work\n";
  expect_done("relabel m.json -o out");
  EXPECT_EQ(outputs().size(), 4U);
  for (const std::string& output : outputs()) expect_labels_of_replay(output);
  EXPECT_TRUE(parts_are_gone());
}

TEST_F(RelabelAtLength, IsDoneByAHundredProcessesAtOnce) {
  for (int i = 0; i < 20; ++i) add_drive("drive" + std::to_string(i));
  make_manifest();
  std::vector<std::jthread> processes;
  for (int i = 0; i < 100; ++i) {
    processes.emplace_back([this, i] {
      expect_done("relabel m.json -o out --shard " + std::to_string(i % 10 + 1) + "/10");
    });
  }
  processes.clear();
  EXPECT_EQ(outputs().size(), 20U);
  expect_outputs_whole();
  for (const std::string& output : outputs()) expect_labels_of_replay(output);
  EXPECT_TRUE(parts_are_gone());
}

}  // namespace
}  // namespace terracut::cli
