// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/arguments/arguments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/scratch_folder.hpp"
#include "tools/cli/settings/setting.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Words with spaces between.
Expected<Arguments> parse(const std::string& line) {
  std::istringstream text(line);
  return parse_arguments({std::istream_iterator<std::string>(text), {}});
}
Options options_of(const std::string& line) {
  auto arguments = parse(line);
  EXPECT_TRUE(arguments) << line << ": " << (arguments ? "" : arguments.error().message);
  return arguments ? arguments->options : Options();
}
std::string refusal_of(const std::string& line) {
  const auto arguments = parse(line);
  if (arguments) return "";
  EXPECT_EQ(arguments.error().code, ErrorCode::kInvalidArgument) << line;
  return arguments.error().message;
}
std::string help_of(const std::string& line) {
  const auto arguments = parse(line);
  return arguments && !arguments->command ? arguments->text : "";
}

TEST(Arguments, WordsBecomeValues) {
  const Options replay = options_of(
      "replay d.pcap --sensor ruby128 --cell-owner last --timestamp ns --geometry ros --port 2368 "
      "--mount-height 1.5 --mount-pitch -2 --stages adjacent --labels=out --loop");
  EXPECT_EQ(replay.capture.file, "d.pcap");
  EXPECT_EQ(replay.capture.sensor, sensor::SensorModel::kRuby128);
  EXPECT_EQ(replay.capture.cell_owner, frame::CellOwner::kFarthest);
  EXPECT_EQ(replay.capture.timestamp, ruby128::RubyTimestamp::kUtcNanoseconds);
  EXPECT_EQ(replay.capture.geometry, hdl64e::GeometryModel::kRosLike);
  EXPECT_EQ(replay.capture.port, 2368);
  EXPECT_EQ(replay.mount.height_m, 1.5);
  EXPECT_EQ(replay.mount.pitch_deg, -2);
  EXPECT_EQ(replay.method.last_stage, stage::Stage::kAdjacentPoints);
  EXPECT_EQ(replay.output.labels, "out");
  EXPECT_EQ(replay.replay.loops, 0);
  EXPECT_EQ(options_of("replay d.pcap --loop 3").replay.loops, 3);
  EXPECT_FALSE(options_of("live --no-lock-memory").realtime.lock_memory);
  EXPECT_EQ(options_of("live --stream-mode 600").stream_mode, 0600U);
  EXPECT_EQ(options_of("simulate --returns dual -o d.pcap").written, "d.pcap");
}

TEST(Arguments, ANameOfACommandMayBeAValue) {
  const auto arguments = parse("top live");
  ASSERT_TRUE(arguments) << arguments.error().message;
  EXPECT_EQ(arguments->command, Command::kTop);
  EXPECT_EQ(arguments->options.watched, "live");
  EXPECT_EQ(options_of("info send").capture.file, "send");
}

TEST(Arguments, WhatIsLeftOutHasItsDefault) {
  const Options live = options_of("live");
  EXPECT_EQ(live.capture.sensor, std::nullopt);
  EXPECT_EQ(live.deadline_ms, 50);
  EXPECT_EQ(live.listen.address, "0.0.0.0:2368");
  EXPECT_EQ(options_of("send d.pcap --to 127.0.0.1").send.play.rate, 1);
  EXPECT_EQ(options_of("replay d.pcap").replay.rate, 0);
}

TEST(Arguments, ListsAreSplitAtCommasAndOptionsRepeated) {
  const Options eval = options_of(
      "eval semantickitti root --method terracut,pfaff --sequences 00,03 --set region.lambda=2 "
      "--variant a=paper,region.lambda=3 --variant b=paper --set pfaff.cell_m=1");
  EXPECT_THAT(eval.eval.methods, ElementsAre("terracut", "pfaff"));
  EXPECT_THAT(eval.eval.sequences, ElementsAre("00", "03"));
  EXPECT_THAT(eval.eval.variants, ElementsAre("a=paper,region.lambda=3", "b=paper"));
  EXPECT_THAT(eval.method.settings, ElementsAre("region.lambda=2", "pfaff.cell_m=1"));
}

TEST(Arguments, AMistypedOptionIsRefusedWithTheOneMeant) {
  EXPECT_EQ(refusal_of("live --deadlin 3"),
            "live has no option --deadlin (did you mean --deadline?)");
  EXPECT_EQ(refusal_of("replay d.pcap --lables=x"),
            "replay has no option --lables (did you mean --labels?)");
  EXPECT_EQ(refusal_of("replay --mount-hieght 3 d.pcap"),
            "replay has no option --mount-hieght (did you mean --mount-height?)");
  EXPECT_EQ(refusal_of("top --frobnicate"), "top has no option --frobnicate");
  EXPECT_EQ(refusal_of("-v"), "terracut has no option -v");
  EXPECT_EQ(refusal_of("--versoin"), "terracut has no option --versoin (did you mean --version?)");
}

TEST(Arguments, AnOptionOfOtherCommandsIsRefusedWithTheirNames) {
  EXPECT_EQ(
      refusal_of("info d.pcap --method pfaff"),
      "info has no option --method; --method is of: replay, view, segment, plan, bench, eval");
  EXPECT_EQ(refusal_of("top --labels l"),
            "top has no option --labels; --labels is of: replay, segment, live");
  EXPECT_EQ(refusal_of("--json r.json info d.pcap"), "--json goes behind the command");
}

TEST(Arguments, AnOptionThatIsNotToBeHadIsRefusedWithWhatThereIsInstead) {
  for (const std::string command : {"live", "calibrate"}) {
    EXPECT_EQ(refusal_of(command + " --method pfaff"),
              command +
                  " has no option --method: it runs our own method, as --profile, --stages "
                  "and --set choose it; --method is of: replay, view, segment, plan, bench, eval");
  }
}

TEST(Arguments, AMistypedCommandIsRefusedWithTheOneMeant) {
  EXPECT_THAT(refusal_of("reply x.pcap"),
              HasSubstr("there is no command 'reply' (did you mean replay?); expected one of"));
  EXPECT_THAT(refusal_of("frobnicate"), AllOf(HasSubstr("'frobnicate'"), HasSubstr("replay")));
  EXPECT_THAT(refusal_of(""), HasSubstr("a command is missing"));
}

TEST(Arguments, ValuesThatAreNotAllowedAreRefusedWithThoseThatAre) {
  const auto expect = [](const std::string& line, const std::string& message) {
    EXPECT_EQ(refusal_of(line), message);
  };
  expect("replay x --rate -1", "replay: --rate: expected a number from 0 to 1000, found '-1'");
  expect("replay x --rate nan", "replay: --rate: expected a number from 0 to 1000, found 'nan'");
  expect("replay x --port 99999",
         "replay: --port: expected a whole number from 0 to 65535, found '99999'");
  expect("replay x --mount-height nan",
         "replay: --mount-height: expected a number from 0.2 to 6 m, found 'nan'");
  expect("replay x --stages all",
         "replay: --stages: expected one of elevation, adjacent, mrf, found 'all'");
  expect("simulate --scene moon -o x",
         "simulate: --scene: expected one of street, highway, rural, flat, hill, found 'moon'");
  expect("simulate --returns triple -o x",
         "simulate: --returns: expected one of single, dual, found 'triple'");
  expect("replay x --from here",
         "replay: --from: expected an IPv4 ADDRESS or ADDRESS:PORT, found 'here'");
  EXPECT_THAT(refusal_of("replay x --start 1e300"), HasSubstr("--start"));
  EXPECT_THAT(refusal_of("replay x --method zang"), HasSubstr("zhang"));
  EXPECT_THAT(refusal_of("simulate --sensor os1 -o x"), HasSubstr("hdl64e"));
  EXPECT_THAT(refusal_of("live --listen lidar:2368"), HasSubstr("ADDRESS:PORT"));
}

TEST(Arguments, ParametersOfTheMethodAreChecked) {
  EXPECT_THAT(refusal_of("segment x --set pfaff.cell_m=0"), HasSubstr("from 0.05 to 10"));
  EXPECT_THAT(refusal_of("replay x --set region.lambda"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(refusal_of("replay x --set region.lamda=1"),
              HasSubstr("no parameter is called 'region.lamda' (did you mean region.lambda?)"));
  EXPECT_THAT(refusal_of("segment x --set pfaff.cell_m=1"),
              AllOf(HasSubstr("pfaff.cell_m=1"), HasSubstr("would change nothing")));
  EXPECT_THAT(refusal_of("segment x --method pfaff --set region.lambda=2"),
              AllOf(HasSubstr("region.lambda=2"), HasSubstr("would change nothing")));
  EXPECT_THAT(refusal_of("plan --set zhang.sectors=90"), HasSubstr("the method zhang"));
  EXPECT_THAT(refusal_of("eval simulated flat --method terracut,pfaff --set zhang.sectors=90"),
              HasSubstr("the method zhang"));
}

TEST(Arguments, WhatIsMissingIsNamed) {
  EXPECT_THAT(refusal_of("replay"),
              StartsWith("replay: FILE is missing: Capture, pcap or pcapng; or a bag"));
  EXPECT_THAT(refusal_of("send d.pcap"),
              AllOf(HasSubstr("send: --to is missing: ADDRESS:PORT"), Not(HasSubstr("\n"))));
  EXPECT_EQ(refusal_of("replay d.pcap --port"), "replay: --port needs a value");
  EXPECT_EQ(refusal_of("replay d.pcap --port --json x"), "replay: --port needs a value");
  EXPECT_EQ(refusal_of("replay d.pcap --json="), "replay: --json needs a value");
  EXPECT_FALSE(parse_arguments({"replay", "d.pcap", "--json", ""}));
  EXPECT_FALSE(parse_arguments({"replay", ""}));
  EXPECT_EQ(refusal_of("--config"), "terracut: --config needs a value");
}

TEST(Arguments, WhatIsTooMuchIsNamed) {
  EXPECT_THAT(refusal_of("info a.pcap b.pcap"), AllOf(HasSubstr("info: "), HasSubstr("b.pcap")));
  EXPECT_THAT(refusal_of("info a.pcap --json b --json c"), HasSubstr("--json"));
}

TEST(Arguments, SomeExcludeOrNeedOneAnother) {
  EXPECT_EQ(refusal_of("segment x --method pfaff --stages mrf"),
            "segment: --stages and --method exclude each other");
  EXPECT_THAT(refusal_of("segment x --profile paper --method pfaff"), HasSubstr("--profile"));
  EXPECT_THAT(refusal_of("replay x --dbc car.dbc"), HasSubstr("replay: --dbc needs --can"));
  EXPECT_THAT(refusal_of("simulate -o x --faults loss@1s:1"), HasSubstr("--faults needs --udp"));
  EXPECT_THAT(refusal_of("simulate --can-log --udp 127.0.0.1"),
              HasSubstr("--can-log needs --output"));
}

TEST(Arguments, HelpShowsValuesRangesAndWhatIsInForce) {
  EXPECT_THAT(help_of("--help"), AllOf(HasSubstr("replay"), HasSubstr("Exit codes")));
  EXPECT_THAT(help_of("live --help"),
              AllOf(HasSubstr("auto|hdl64e|ruby128"), HasSubstr("[1 .. 10000] (default: 50)")));
  EXPECT_THAT(help_of("replay --help"), HasSubstr("bogoslavskyi: "));
  EXPECT_THAT(help_of("send --help"),
              AllOf(HasSubstr("[OPTIONS] FILE"), HasSubstr("--to TEXT REQUIRED")));
}

TEST(Arguments, HelpShowsWhatAnOptionNeedsAndExcludes) {
  EXPECT_THAT(help_of("replay --help"), AllOf(HasSubstr("needs --can"), HasSubstr("not with --m")));
  EXPECT_THAT(help_of("simulate --help"), HasSubstr("each fault did; needs --udp"));
  EXPECT_THAT(help_of("send --help"), Not(HasSubstr("--udp"))) << "it always sends";
}

TEST(Arguments, EveryOptionOfACommandIsItsOwn) {
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    for (const Setting& setting : settings()) {
      const auto command = static_cast<Command>(i);
      if (setting.option.empty() || !setting.commands.contains(command)) continue;
      EXPECT_EQ(find_option(command, setting.name()), &setting)
          << kCommands[i].name << " " << setting.option;
    }
  }
}

class ArgumentsAndFile : public test::InScratchFolder {
 protected:
  /// "--config FILE ", a file of that content.
  [[nodiscard]] std::string config(const std::string& content) const {
    std::ofstream(folder_ / "a.yaml") << content;
    return "--config " + (folder_ / "a.yaml").string() + " ";
  }
};

TEST_F(ArgumentsAndFile, TheFileIsNamedBeforeAndBehindTheCommand) {
  const std::string file = config("mount: {height_m: 2.5}\n");
  EXPECT_EQ(options_of(file + "config").mount.height_m, 2.5);
  EXPECT_EQ(options_of("config " + file).mount.height_m, 2.5);
  EXPECT_EQ(options_of("replay d.pcap --config=" + file.substr(9)).mount.height_m, 2.5);
}

TEST_F(ArgumentsAndFile, TheCommandLineWins) {
  const std::string file = config("deadline: {limit_ms: 30}\nrecorder: {seconds: 5}\n");
  const Options live = options_of(file + "live --deadline 40");
  EXPECT_EQ(live.deadline_ms, 40);
  EXPECT_EQ(live.recorder.seconds, 5);
  EXPECT_THAT(help_of(file + "live --help"), HasSubstr("(default: 30)"));
}

TEST_F(ArgumentsAndFile, ACommandTakesWhatItLooksAtAlone) {
  const std::string file =
      config("output: {json: r.json, pcd: p}\nsensor: {model: ruby128}\nreplay: {rate: 2}\n");
  EXPECT_EQ(options_of(file + "segment scans").output.json, folder_ / "r.json");
  EXPECT_EQ(options_of(file + "info d.pcap").output.json, "");
  EXPECT_EQ(options_of(file + "live").output.pcd, "");
  EXPECT_EQ(options_of(file + "simulate -o d").capture.sensor, sensor::SensorModel::kRuby128);
  EXPECT_EQ(options_of(file + "send d.pcap --to 127.0.0.1").send.play.rate, 1);
}

TEST_F(ArgumentsAndFile, ASetupOfTheCommandLineIsNotMovedByTheFile) {
  const std::string file = config("mount: {height_m: 3, setup: a}\n");
  EXPECT_EQ(options_of(file + "replay d --setup b").mount.height_m, std::nullopt);
  EXPECT_EQ(options_of(file + "replay d --setup b").mount.setup, "b");
  EXPECT_EQ(options_of(file + "replay d --setup b --mount-height 2").mount.height_m, 2);
  EXPECT_EQ(options_of(file + "replay d").mount.height_m, 3);
}

TEST_F(ArgumentsAndFile, ParametersOfTheCommandLineComeAfterTheFiles) {
  const std::string file = config("method:\n  min_cut: {max_unknown: 0}\n");
  EXPECT_THAT(options_of(file + "replay d --set min_cut.max_unknown=16384").method.settings,
              ElementsAre("min_cut.max_unknown=0", "min_cut.max_unknown=16384"));
  EXPECT_EQ(refusal_of(file + "replay d --method pfaff"), "") << "the file is for all commands";
}

TEST_F(ArgumentsAndFile, WhatTheFileSaysIsWhatAnOptionNeeds) {
  EXPECT_EQ(refusal_of(config("motion: {can: can0}\n") + "live --dbc car.dbc"), "");
}

}  // namespace
}  // namespace terracut::cli
