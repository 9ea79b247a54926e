// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <regex>
#include <sstream>

#include "cli_fixture.hpp"
#include "tests/support/places.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class Configuration : public Cli {
 protected:
  [[nodiscard]] Outcome read(const std::string& content) const {
    write("terracut.yaml", content);
    return run("--config terracut.yaml config");
  }
  /// The file is refused with a message that has all of these.
  void expect_refused(const std::string& content, const std::string& line,
                      const std::vector<std::string>& parts) const {
    const Outcome outcome = read(content);
    EXPECT_EQ(outcome.exit_code, 3) << content;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("error: terracut.yaml: line " + line + ": "));
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
  }
};

/// The default file with the comment sign taken from every key that has a value.
std::string every_key_said(const std::string& file) {
  return std::regex_replace(file, std::regex("(^|\n)( +)#([a-z0-9_]+: [^\n]+)"), "$1$2$3");
}

TEST_F(Configuration, PageShowsWhatTheProgramHas) {
  const Outcome table = run("config --print-table");
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(content_of(test::source_folder() / "docs/configuration.md"), EndsWith(table.out))
      << "print it anew with `terracut config --print-table`";
}

TEST_F(Configuration, ServicesFileHasEveryKeyAndSaysOnlyWhereDumpsGo) {
  const fs::path file = test::source_folder() / "tools/service/terracut.yaml";
  EXPECT_EQ(content_of(file), run("--config " + quoted(file) + " config").out)
      << "print it anew with `terracut --config FILE config`";
  std::string defaults = run("config --print-default").out;
  const std::string dumps = "\n  #folder:\n";
  ASSERT_NE(defaults.find(dumps), std::string::npos);
  defaults.replace(defaults.find(dumps), dumps.size(), "\n  folder: /var/lib/terracut/dumps\n");
  EXPECT_EQ(content_of(file), defaults);
}

TEST_F(Configuration, DefaultFileChangesNothing) {
  const std::string printed = run("config --print-default").out;
  EXPECT_EQ(read(printed).out, printed);
}

TEST_F(Configuration, EveryDefaultIsAValueThatItsKeyAllows) {
  const std::string printed = run("config --print-default").out;
  const std::string said = every_key_said(printed);
  ASSERT_THAT(said, HasSubstr("\n  limit_ms: 50\n"));
  ASSERT_THAT(said, HasSubstr("\n    columns_per_sector: 10\n"));
  const Outcome outcome = read(said);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, printed) << "said or left out, a default is the same";
}

TEST_F(Configuration, WhatAFileSaysIsPrintedAndReadAgain) {
  const Outcome first = read(
      "sensor: {model: ruby128, nominal_calibration: yes}\n"
      "input:\n  from: 192.168.1.200\n  listen: '0.0.0.0:6699'\n  device_port: 7789\n"
      "mount:\n  height_m: 1.9\n  pitch_deg: -1.5\n"
      "method:\n  stages: adjacent\n  elevation_map:\n    obstacle_height_m: 0.25\n"
      "realtime: {segment_core: 3}\n");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(
      first.out,
      AllOf(HasSubstr("\n  model: ruby128\n"), HasSubstr("\n  nominal_calibration: yes\n"),
            HasSubstr("\n  from: 192.168.1.200\n"), HasSubstr("\n  listen: '0.0.0.0:6699'\n"),
            HasSubstr("\n  device_port: 7789\n"), HasSubstr("\n  height_m: 1.9\n"),
            HasSubstr("\n  pitch_deg: -1.5\n"), HasSubstr("\n  #roll_deg:\n"),
            HasSubstr("\n  stages: adjacent\n"), HasSubstr("\n    obstacle_height_m: 0.25\n"),
            HasSubstr("\n  segment_core: 3\n"), HasSubstr("\n  #receive_priority: 80\n")));
  EXPECT_EQ(read(first.out).out, first.out);
}

TEST_F(Configuration, UnknownKeysAreRefusedWithTheirNeighbours) {
  expect_refused("sensor:\n  model: auto\nmount:\n  hieght_m: 2\n", "4",
                 {"unknown key 'mount.hieght_m'", "'mount' has setup, height_m, roll_deg"});
  expect_refused("\n\nmounting: {height_m: 2}\n", "3",
                 {"unknown key 'mounting'", "sensor, input, mount, method"});
  expect_refused("method:\n  grid:\n    columns: 3\n", "3",
                 {"unknown key 'method.grid.columns'", "columns_per_sector, min_band_m"});
}

TEST_F(Configuration, ValuesOutOfRangeAreRefusedWithTheRange) {
  expect_refused("mount:\n  height_m: 9\n", "2",
                 {"mount.height_m: expected a number from 0.2 to 6 m, found '9'"});
  expect_refused("mount:\n  height_m: nan\n", "2", {"from 0.2 to 6 m, found 'nan'"});
  expect_refused("mount:\n  height_m: 1.7 m\n", "2", {"found '1.7 m'"});
  expect_refused("sensor:\n  columns: 1800.5\n", "2",
                 {"a whole number from 16 to 36000 columns, found '1800.5'"});
  expect_refused("sensor:\n  model: vlp16\n", "2",
                 {"sensor.model: expected one of auto, hdl64e, ruby128, found 'vlp16'"});
  expect_refused("realtime:\n  lock_memory: maybe\n", "2", {"expected yes or no, found 'maybe'"});
  expect_refused("input:\n  from: 192.168.1\n", "2", {"an IPv4 address, found '192.168.1'"});
  expect_refused("input:\n  listen: 0.0.0.0\n", "2", {"an IPv4 ADDRESS:PORT"});
  expect_refused("metrics:\n  address: '127.0.0.1:70000'\n", "2", {"ADDRESS:PORT or off"});
  expect_refused("output:\n  stream: 99999\n", "2",
                 {"output.stream: expected an IPv4 ADDRESS:PORT, a PORT or the path", "'99999'"});
  expect_refused("metrics:\n  name: ../x\n", "2", {"a name of letters, digits"});
  expect_refused("method:\n  region:\n    lambda: 0\n", "3",
                 {"method.region.lambda: expected a number from 0.0001 to 1000, found '0'"});
}

TEST_F(Configuration, FilesThatAreNotThereAreRefused) {
  for (const std::string key : {"sensor:\n  calibration", "mount:\n  setup", "motion:\n  dbc"}) {
    const Outcome outcome = read(key + ": nothere.xml\n");
    EXPECT_EQ(outcome.exit_code, 3) << key;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("nothere.xml"));
  }
}

TEST_F(Configuration, ValuesOfTheWrongKindAreRefused) {
  expect_refused("mount: 3\n", "1", {"mount: expected keys below it, found a value"});
  expect_refused("mount:\n  height_m: [1, 2]\n", "2", {"expected one value, found a list"});
  expect_refused("mount:\n  height_m: {m: 1}\n", "2", {"expected one value, found keys"});
  expect_refused("mount:\n  height_m:\n", "2", {"expected one value, found none"});
  expect_refused("- mount\n", "1", {"expected sections"});
  expect_refused("sensor:\n  model: ''\n", "2", {"found ''"});
  expect_refused("sensor:\n  calibration: ''\n", "2", {"a file or folder"});
}

TEST_F(Configuration, AKeySaidTwiceIsRefused) {
  expect_refused("mount:\n  height_m: 1.7\n  height_m: 1.8\n", "3",
                 {"'mount.height_m' stands here a second time, after line 2"});
  expect_refused("mount: {height_m: 1.7}\nsensor:\nmount: {roll_deg: 1}\n", "3",
                 {"'mount' stands here a second time, after line 1"});
}

TEST_F(Configuration, BrokenFilesAreRefused) {
  expect_refused("mount:\n  height_m: [1\n", "3", {"not well-formed YAML"});
  expect_refused("a: &x 1\nb: *x\n", "2", {"aliases"});
  const Outcome absent = run("--config absent.yaml config");
  EXPECT_EQ(absent.exit_code, 3);
  EXPECT_THAT(absent.err, HasSubstr("absent.yaml"));
  const Outcome empty = read("");
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err, HasSubstr("is empty"));
}

TEST_F(Configuration, EmptySectionsAndCommentsSayNothing) {
  const std::string defaults = run("config --print-default").out;
  EXPECT_EQ(read("# nothing\n").out, defaults);
  EXPECT_EQ(read("mount:\nmethod:\n  grid:\n").out, defaults);
}

TEST_F(Configuration, IsTakenBeforeAndBehindTheCommand) {
  write("a.yaml", "mount: {height_m: 2.5}\n");
  for (const char* arguments :
       {"--config a.yaml config", "config --config a.yaml", "config --config=a.yaml"}) {
    EXPECT_THAT(run(arguments).out, HasSubstr("\n  height_m: 2.5\n")) << arguments;
  }
  EXPECT_THAT(run("--config a.yaml config --print-default").out, Not(HasSubstr("height_m: 2.5")));
}

TEST_F(Configuration, RelativePathsAreTakenFromTheFilesFolder) {
  fs::create_directory(folder_ / "vehicle");
  fs::copy_file(kDriveCalibration, folder_ / "vehicle" / "unit.xml");
  write("vehicle/a.yaml", "sensor: {calibration: unit.xml}\noutput: {json: /run/report.json}\n");
  const Outcome outcome = run("--config vehicle/a.yaml config");
  EXPECT_THAT(outcome.out, HasSubstr("\n  calibration: vehicle/unit.xml\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n  json: /run/report.json\n"));
}

TEST_F(Configuration, CommandsStartFromItAndTheCommandLineWins) {
  write("a.yaml",
        "sensor: {model: ruby128}\nmethod: {profile: paper}\n"
        "simulate: {duration_s: 0.1, seed: 5}\n");
  expect_done("--config a.yaml plan --json file.json");
  expect_done("plan --sensor ruby128 --profile paper --json options.json");
  expect_done("--config a.yaml plan --sensor hdl64e --json both.json");
  expect_done("plan --profile paper --json hdl64e.json");
  EXPECT_EQ(content_of(folder_ / "file.json"), content_of(folder_ / "options.json"));
  EXPECT_EQ(content_of(folder_ / "both.json"), content_of(folder_ / "hdl64e.json"));
  EXPECT_NE(content_of(folder_ / "file.json"), content_of(folder_ / "both.json"));

  expect_done("--config a.yaml simulate --sensor hdl64e -o file.pcap");
  expect_done("simulate --duration 0.1 --seed 5 -o options.pcap");
  EXPECT_EQ(content_of(folder_ / "file.pcap"), content_of(folder_ / "options.pcap"));
}

TEST_F(Configuration, SettingsOfTheCommandLineComeAfterTheFiles) {
  write("a.yaml",
        "output: {json: a.json}\n"
        "method:\n  min_cut: {max_unknown: 0}\n  elevation_map: {obstacle_height_m: 1.5}\n");
  const std::string replay = "replay " + quoted(kDrive) + " --duration 0.3";
  expect_done("--config a.yaml " + replay);
  const auto of_file = json("a.json");
  EXPECT_GT(of_file["frames"][0]["min_cut"]["unknown"], 0);
  EXPECT_EQ(of_file["frames"][0]["min_cut"]["coarse"], of_file["frames"][0]["min_cut"]["unknown"]);
  expect_done("--config a.yaml " + replay + " --set min_cut.max_unknown=16384 --json b.json");
  EXPECT_LT(json("b.json")["frames"][0]["min_cut"]["coarse"],
            json("b.json")["frames"][0]["min_cut"]["unknown"]);
  EXPECT_EQ(json("b.json")["frames"][0]["min_cut"]["unknown"],
            of_file["frames"][0]["min_cut"]["unknown"])
      << "the other setting still holds";
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
