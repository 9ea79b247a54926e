// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What commands do with a configuration file. How it is read: settings/configuration_test.cpp
#include "cli_fixture.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

using Configuration = Cli;

TEST_F(Configuration, FilesThatAreNotThereAreRefused) {
  for (const std::string key : {"sensor:\n  calibration", "mount:\n  setup", "motion:\n  dbc"}) {
    write("terracut.yaml", key + ": nothere.xml\n");
    const Outcome outcome = run("--config terracut.yaml config");
    EXPECT_EQ(outcome.exit_code, 3) << key;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("nothere.xml"));
  }
  const Outcome absent = run("--config absent.yaml config");
  EXPECT_EQ(absent.exit_code, 3);
  EXPECT_THAT(absent.err, HasSubstr("absent.yaml"));
}

TEST_F(Configuration, CommandsStartFromItAndTheCommandLineWins) {
  write("a.yaml",
        "sensor: {model: ruby128}\nmethod: {profile: paper}\n"
        "simulate: {duration_s: 0.1, seed: 5}\n");
  expect_done("--config a.yaml plan --json file.json");
  expect_done("plan --sensor ruby128 --profile paper --json options.json");
  expect_done("--config a.yaml plan --sensor hdl64e --json both.json");
  expect_done("plan --profile paper --json hdl64e.json");
  // What of the program itself is resident is counted anew each time.
  const auto parts = [&](const char* name) { return json(name)["parts"]; };
  ASSERT_FALSE(parts("file.json").empty());
  EXPECT_EQ(parts("file.json"), parts("options.json"));
  EXPECT_EQ(parts("both.json"), parts("hdl64e.json"));
  EXPECT_NE(parts("file.json"), parts("both.json"));

  expect_done("--config a.yaml simulate --sensor hdl64e -o file.pcap");
  expect_done("simulate --duration 0.1 --seed 5 -o options.pcap");
  EXPECT_EQ(content_of(folder_ / "file.pcap"), content_of(folder_ / "options.pcap"));
}

TEST_F(Configuration, ASetupOfTheCommandLineIsNotMovedByTheFile) {
  write("a.yaml", "mount: {height_m: 3}\n");
  expect_done("calibrate " + quoted(kDrive) + " --keep-mount --mount-height 1.73 -o setup.yaml");
  const std::string labels = "replay " + quoted(kDrive) + " --duration 0.3 --setup setup.yaml ";
  expect_done(labels + "--labels plain");
  expect_done("--config a.yaml " + labels + "--labels filed");
  expect_done(labels + "--mount-height 3 --labels moved");
  EXPECT_EQ(content_of(folder_ / "plain/000001.label"), content_of(folder_ / "filed/000001.label"));
  EXPECT_NE(content_of(folder_ / "plain/000001.label"), content_of(folder_ / "moved/000001.label"));
}

}  // namespace
}  // namespace terracut::cli
