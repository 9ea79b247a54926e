// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/cli/settings/configuration_file.hpp"
#include "tools/cli/settings/configuration_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

/// What is in force after a file was read.
std::string printed_again(const std::string& content) {
  const auto options = parse_configuration(content, "terracut.yaml", "");
  return options ? configuration_yaml(*options) : options.error().message;
}

/// The file is refused with a message that has all of these.
void expect_refused(const std::string& content, const std::string& line,
                    const std::vector<std::string>& parts) {
  const auto options = parse_configuration(content, "terracut.yaml", "");
  ASSERT_FALSE(options) << content;
  EXPECT_THAT(options.error().message, HasSubstr("terracut.yaml: line " + line + ": "));
  for (const std::string& part : parts) EXPECT_THAT(options.error().message, HasSubstr(part));
}

/// The default file with the comment sign taken from every key that has a value.
std::string every_key_said(const std::string& file) {
  return std::regex_replace(file, std::regex("(^|\n)( +)#([a-z0-9_]+: [^\n]+)"), "$1$2$3");
}

TEST(ConfigurationFile, PageShowsWhatTheProgramHas) {
  EXPECT_THAT(content_of(test::source_folder() / "docs/reference/configuration.md"),
              EndsWith(configuration_table()))
      << "print it anew with `terracut config --print-table`";
}

TEST(ConfigurationFile, ServicesFileHasEveryKeyAndSaysOnlyWhereDumpsGo) {
  const fs::path path = test::source_folder() / "tools/build/service/terracut.yaml";
  const auto file = read_configuration(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(content_of(path), configuration_yaml(*file))
      << "print it anew with `terracut --config FILE config`";
  std::string defaults = configuration_yaml({});
  const std::string dumps = "\n  #folder:\n";
  ASSERT_NE(defaults.find(dumps), std::string::npos);
  defaults.replace(defaults.find(dumps), dumps.size(), "\n  folder: /var/lib/terracut/dumps\n");
  EXPECT_EQ(content_of(path), defaults);
}

TEST(ConfigurationFile, EveryPresetIsAccepted) {
  int presets = 0;
  for (const char* folder : {"tools/presets", "tools/ros2/terracut_ros/config"}) {
    for (const auto& entry : fs::directory_iterator(test::source_folder() / folder)) {
      const auto options = read_configuration(entry.path());
      ASSERT_TRUE(options) << options.error().message;
      ++presets;
    }
  }
  EXPECT_GE(presets, 8);
}

TEST(ConfigurationFile, DefaultFileChangesNothing) {
  const std::string printed = configuration_yaml({});
  EXPECT_EQ(printed_again(printed), printed);
}

TEST(ConfigurationFile, EveryDefaultIsAValueThatItsKeyAllows) {
  const std::string printed = configuration_yaml({});
  const std::string said = every_key_said(printed);
  ASSERT_THAT(said, HasSubstr("\n  limit_ms: 50\n"));
  ASSERT_THAT(said, HasSubstr("\n    columns_per_sector: 10\n"));
  EXPECT_EQ(printed_again(said), printed) << "said or left out, a default is the same";
}

TEST(ConfigurationFile, WhatAFileSaysIsPrintedAndReadAgain) {
  const std::string first = printed_again(
      "sensor: {model: ruby128, nominal_calibration: yes}\n"
      "input:\n  from: 192.168.1.200\n  listen: '0.0.0.0:6699'\n  device_port: 7789\n"
      "mount:\n  height_m: 1.9\n  pitch_deg: -1.5\n"
      "method:\n  stages: adjacent\n  elevation_map:\n    obstacle_height_m: 0.25\n"
      "realtime: {core: 3}\n");
  EXPECT_THAT(
      first,
      AllOf(HasSubstr("\n  model: ruby128\n"), HasSubstr("\n  nominal_calibration: yes\n"),
            HasSubstr("\n  from: 192.168.1.200\n"), HasSubstr("\n  listen: '0.0.0.0:6699'\n"),
            HasSubstr("\n  device_port: 7789\n"), HasSubstr("\n  height_m: 1.9\n"),
            HasSubstr("\n  pitch_deg: -1.5\n"), HasSubstr("\n  #roll_deg:\n"),
            HasSubstr("\n  stages: adjacent\n"), HasSubstr("\n    obstacle_height_m: 0.25\n"),
            HasSubstr("\n  core: 3\n"), HasSubstr("\n  #priority: 80\n")));
  EXPECT_EQ(printed_again(first), first);
}

TEST(ConfigurationFile, APortAloneIsEnough) {
  EXPECT_THAT(printed_again("input: {listen: 6699}\nmetrics: {address: 9465}\n"),
              AllOf(HasSubstr("\n  listen: 6699\n"), HasSubstr("\n  address: 9465\n")));
}

TEST(ConfigurationFile, UnknownKeysAreRefusedWithWhatWasMeantAndTheirNeighbours) {
  expect_refused("sensor:\n  model: auto\nmount:\n  hieght_m: 2\n", "4",
                 {"unknown key 'mount.hieght_m' (did you mean mount.height_m?)",
                  "'mount' has setup, height_m, roll_deg"});
  expect_refused("\n\nmounting: {height_m: 2}\n", "3",
                 {"unknown key 'mounting' (did you mean mount?)", "sensor, input, mount, method"});
  expect_refused(
      "method:\n  grid:\n    columns: 3\n", "3",
      {"unknown key 'method.grid.columns' (did you mean method.grid.columns_per_sector?)",
       "columns_per_sector, min_band_m"});
  expect_refused("frobnicate: 3\n", "1", {"unknown key 'frobnicate'; there are the sections"});
}

TEST(ConfigurationFile, ValuesOutOfRangeAreRefusedWithTheRange) {
  expect_refused("mount:\n  height_m: 9\n", "2",
                 {"mount.height_m: expected a number from 0.2 to 6 m, found '9'"});
  expect_refused("mount:\n  height_m: nan\n", "2", {"from 0.2 to 6 m, found 'nan'"});
  expect_refused("mount:\n  height_m: 1.7 m\n", "2", {"found '1.7 m'"});
  expect_refused("sensor:\n  columns: 1800.5\n", "2",
                 {"a whole number from 16 to 36000 columns, found '1800.5'"});
  expect_refused("sensor:\n  model: os1\n", "2",
                 {"sensor.model: expected one of auto, hdl64e, ruby128, rs32, helios, vlp16, "
                  "hdl32e, vlp32c, vls128, pandar40p, pandar64, pandarqt64, pandarqt128, "
                  "pandarxt16, pandarxt32, pandarxt32m, ot128, pandar128, ouster32, ouster64, "
                  "ouster128, found 'os1'"});
  expect_refused("realtime:\n  lock_memory: maybe\n", "2", {"expected yes or no, found 'maybe'"});
  expect_refused("input:\n  from: 192.168.1\n", "2",
                 {"an IPv4 ADDRESS or ADDRESS:PORT, found '192.168.1'"});
  expect_refused("input:\n  listen: 0.0.0.0\n", "2", {"an IPv4 ADDRESS:PORT"});
  expect_refused("metrics:\n  address: '127.0.0.1:70000'\n", "2",
                 {"an IPv4 ADDRESS:PORT, a PORT or off"});
  expect_refused("output:\n  stream: 99999\n", "2",
                 {"output.stream: expected an IPv4 ADDRESS:PORT, a PORT or the path", "'99999'"});
  expect_refused("metrics:\n  name: ../x\n", "2", {"a name of letters, digits"});
  expect_refused("method:\n  region:\n    lambda: 0\n", "3",
                 {"method.region.lambda: expected a number from 0.0001 to 1000, found '0'"});
}

TEST(ConfigurationFile, ValuesOfTheWrongKindAreRefused) {
  expect_refused("mount: 3\n", "1", {"mount: expected keys below it, found a value"});
  expect_refused("mount:\n  height_m: [1, 2]\n", "2", {"expected one value, found a list"});
  expect_refused("mount:\n  height_m: {m: 1}\n", "2", {"expected one value, found keys"});
  expect_refused("mount:\n  height_m:\n", "2", {"expected one value, found none"});
  expect_refused("- mount\n", "1", {"expected sections"});
  expect_refused("sensor:\n  model: ''\n", "2", {"found ''"});
  expect_refused("sensor:\n  calibration: ''\n", "2", {"a file or folder"});
}

TEST(ConfigurationFile, AKeySaidTwiceIsRefused) {
  expect_refused("mount:\n  height_m: 1.7\n  height_m: 1.8\n", "3",
                 {"'mount.height_m' stands here a second time, after line 2"});
  expect_refused("mount: {height_m: 1.7}\nsensor:\nmount: {roll_deg: 1}\n", "3",
                 {"'mount' stands here a second time, after line 1"});
}

TEST(ConfigurationFile, BrokenFilesAreRefused) {
  expect_refused("mount:\n  height_m: [1\n", "3", {"not well-formed YAML"});
  expect_refused("a: &x 1\nb: *x\n", "2", {"aliases"});
  const auto empty = parse_configuration("", "terracut.yaml", "");
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message, HasSubstr("is empty"));
}

TEST(ConfigurationFile, ASecondDocumentIsRefusedInsteadOfIgnored) {
  expect_refused("sensor:\n  model: hdl64e\n---\nmount:\n  height_m: 2\n", "4",
                 {"a second document (after a line '---'); expected one"});
  expect_refused("---\n---\nsensor:\n  model: hdl64e\n", "3", {"a second document"});
  const std::string one = printed_again("sensor:\n  model: hdl64e\n");
  EXPECT_EQ(printed_again("---\nsensor:\n  model: hdl64e\n...\n"), one);
  EXPECT_EQ(printed_again("sensor:\n  model: hdl64e\n---\n"), one);
}

TEST(ConfigurationFile, EmptySectionsAndCommentsSayNothing) {
  EXPECT_EQ(printed_again("# nothing\n"), configuration_yaml({}));
  EXPECT_EQ(printed_again("mount:\nmethod:\n  grid:\n"), configuration_yaml({}));
}

TEST(ConfigurationFile, RelativePathsAreTakenFromTheFilesFolder) {
  const auto options = parse_configuration(
      "sensor: {calibration: unit.xml}\noutput: {json: /run/report.json}\n", "a.yaml", "vehicle");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->capture.calibration, "vehicle/unit.xml");
  EXPECT_EQ(options->output.json, "/run/report.json");
}

}  // namespace
}  // namespace terracut::cli
