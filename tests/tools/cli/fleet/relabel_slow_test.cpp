// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The same with more of everything; for ./tools/test --all.
#include <csignal>
#include <fstream>
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

/// By tools/fleet/throughput, whose figures are the machine's; but not what they are of.
TEST_F(RelabelAtLength, IsMeasuredByOneProcessAndByTwo) {
  add_drive("a");
  add_drive("b");
  make_manifest();
  const fs::path script = test::source_folder() / "tools" / "fleet" / "throughput";
  const std::string command = "cd " + quoted(folder_) + " && TERRACUT=" + quoted(test::program()) +
                              " " + quoted(script) + " m.json --processes 2 --rounds 1 >table.txt";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream table(folder_ / "table.txt");
  std::string header;
  std::getline(table, header);
  for (const int expected : {1, 2}) {
    int processes = 0;
    double per_second = 0, times_one = 0, cpu_ms = 0, others = 0, read_kb = 0, written_kb = 0;
    table >> processes >> per_second >> times_one >> cpu_ms >> others >> read_kb >> written_kb;
    std::string rest;
    std::getline(table, rest);
    EXPECT_EQ(processes, expected);
    EXPECT_GT(per_second, 0);
    // Each frame's packets are read twice, its labels written once.
    EXPECT_GT(read_kb, 2.0 * static_cast<double>(fs::file_size(kDrive)) / kDriveFrames / 1e3);
    EXPECT_GT(written_kb, 400);
    EXPECT_LT(written_kb, 1'000);
  }
  EXPECT_FALSE(table >> header) << header;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_FALSE(entry.path().filename().string().starts_with("throughput-")) << entry.path();
  }
}

}  // namespace
}  // namespace terracut::cli
