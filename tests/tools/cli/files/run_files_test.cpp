// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/files/run_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/cli/arguments/command_files.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using Kind = RunFiles::Kind;

/// A replay of `capture`, and where its results go.
Options replay_of(const fs::path& capture, const fs::path& labels, const fs::path& json) {
  Options replay;
  replay.capture.file = capture;
  replay.output.labels = labels;
  replay.output.json = json;
  return replay;
}
Options segment_of(const fs::path& scans, const fs::path& labels, const fs::path& json) {
  Options segment;
  segment.scans = scans;
  segment.output.labels = labels;
  segment.output.json = json;
  return segment;
}
Options results_to(const fs::path& json) {
  Options options;
  options.output.json = json;
  return options;
}

/// Works in a folder of its own, so that paths can be typed as people do.
class RunFilesTest : public test::InScratchFolder {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    fs::current_path(folder_);
  }
  void TearDown() override { fs::current_path(before_); }

  static void make(const fs::path& file) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    std::ofstream(file) << "the user's";
  }
  /// Why the run of these files is refused; empty: it is not.
  static std::string refusal(const RunFiles& files) {
    const auto claims = claim_outputs(files);
    return claims ? "" : claims.error().message;
  }
  static std::string refusal_of(Command command, const Options& options) {
    return refusal(files_of(command, options));
  }

  fs::path before_;
};

TEST_F(RunFilesTest, NoOutputIsAnInputWhateverItIsCalled) {
  make("d.pcap");
  fs::create_symlink("d.pcap", "link");
  fs::create_hard_link("d.pcap", "hard");
  for (const char* name : {"d.pcap", "./d.pcap", "link", "hard"}) {
    EXPECT_THAT(refusal_of(Command::kReplay, replay_of("d.pcap", "", name)),
                AllOf(HasSubstr(std::string("--json ") + name),
                      HasSubstr("is the capture that the run reads (FILE d.pcap)")))
        << name;
  }
  EXPECT_EQ(refusal_of(Command::kReplay, replay_of("d.pcap", "", "r.json")), "");
}

TEST_F(RunFilesTest, NoCommandWritesOverWhatItReads) {
  for (const char* name : {"a", "b", "c"}) make(name);
  const auto expect_named = [](const std::string& refusal, const char* output, const char* input) {
    EXPECT_THAT(refusal, AllOf(HasSubstr(output), HasSubstr(input)));
  };
  Options replay = replay_of("a", "", "b");
  replay.capture.calibration = "b";
  replay.mount.setup = "c";
  expect_named(refusal_of(Command::kReplay, replay), "--json b", "the calibration");
  replay.output.json = "c";
  expect_named(refusal_of(Command::kReplay, replay), "--json c", "the setup");
  replay = replay_of("a", "", "b");
  replay.can_recording = "b";
  replay.motion.dbc = "c";
  expect_named(refusal_of(Command::kReplay, replay), "--json b", "the CAN recording");
  replay.output.json = "c";
  expect_named(refusal_of(Command::kReplay, replay), "--json c", "the DBC file");

  Options calibrate;
  calibrate.capture.file = calibrate.written = "a";
  expect_named(refusal_of(Command::kCalibrate, calibrate), "--output a", "the capture");
  Options info;
  info.capture.file = info.output.json = "a";
  expect_named(refusal_of(Command::kInfo, info), "--json a", "the capture");
  Options bench;
  bench.capture.file = bench.output.json = "a";
  expect_named(refusal_of(Command::kBench, bench), "--json a", "the capture");
  Options send;
  send.capture.file = send.output.json = "a";
  expect_named(refusal_of(Command::kSend, send), "--json a", "the capture");
  Options live;
  live.capture.calibration = live.trace = "a";
  expect_named(refusal_of(Command::kLive, live), "--trace a", "the calibration");
  Options eval;
  eval.eval.classes = eval.output.json = "a";
  expect_named(refusal_of(Command::kEval, eval), "--json a", "the table of classes");
  Arguments plan;
  plan.command = Command::kPlan;
  plan.options = results_to("a");
  plan.configuration = "a";
  EXPECT_THAT(refusal(files_of(plan)), HasSubstr("the configuration"));
}

TEST_F(RunFilesTest, ADriveIsNotWrittenOverTheTableItIsMadeOf) {
  make("d.calibration.xml");
  Options simulate;
  simulate.capture.calibration = "d.calibration.xml";
  simulate.written = "d.pcap";
  EXPECT_THAT(refusal_of(Command::kSimulate, simulate),
              HasSubstr("d.calibration.xml is the calibration"));
  Options encode;
  encode.scans = "s";
  encode.capture.calibration = "d.calibration.xml";
  encode.written = "./d.pcap";
  EXPECT_THAT(refusal_of(Command::kEncode, encode), HasSubstr("is the calibration"));
}

TEST_F(RunFilesTest, TheTruthOfASequenceIsNotReplaced) {
  make("01/velodyne/000000.bin");
  make("01/labels/000000.label");
  make("01/poses.txt");
  const auto segment = [&](const char* scans, const fs::path& labels) {
    return refusal_of(Command::kSegment, segment_of(scans, labels, ""));
  };
  EXPECT_THAT(segment("01", "01/labels"),
              HasSubstr("--labels 01/labels is the truth of the scans that the run reads"));
  EXPECT_THAT(segment("01", "01/velodyne"), HasSubstr("is the folder of scans"));
  EXPECT_THAT(segment("01/velodyne", "01/labels"), HasSubstr("is the truth of the scans"));
  EXPECT_THAT(segment("01/velodyne", "01/labels/new"), HasSubstr("lies in the truth"));
  EXPECT_EQ(segment("01", "01/predictions"), "") << "as SemanticKITTI lays them out";
  fs::current_path("01");
  EXPECT_THAT(segment(".", "labels"), HasSubstr("is the truth of the scans"));
  EXPECT_THAT(refusal_of(Command::kSegment, segment_of(".", "", "poses.txt")),
              HasSubstr("is a part of the sequence"));
}

TEST_F(RunFilesTest, NothingIsWrittenIntoAFolderThatIsRead) {
  make("scans/000000.bin");
  make("truth/000000.label");
  EXPECT_THAT(refusal_of(Command::kSegment, segment_of("scans", "scans/labels", "")),
              HasSubstr("--labels scans/labels lies in the folder of scans"));
  Options replay = replay_of("d", "", "truth/r.json");
  replay.output.truth = "truth";
  EXPECT_THAT(refusal_of(Command::kReplay, replay), HasSubstr("lies in the truth"));
  replay.output.json.clear();
  replay.output.png = "./truth";
  EXPECT_THAT(refusal_of(Command::kReplay, replay), HasSubstr("--png ./truth is the truth"));
  Options eval;
  eval.eval.dataset = "semantickitti";
  eval.eval.root = "data";
  eval.eval.predictions = "data/sequences/00";
  EXPECT_THAT(refusal_of(Command::kEval, eval),
              HasSubstr("--predictions data/sequences/00 lies in the dataset"));
  eval.eval.predictions = "data/predictions";
  EXPECT_EQ(refusal_of(Command::kEval, eval), "");
}

TEST_F(RunFilesTest, AFolderThatIsReplacedHoldsNoInput) {
  make("d.truth/000000.label");
  RunFiles files;
  files.read("--truth", "d.truth/000000.label", "the truth");
  files.write("--output", "d.truth", Kind::kReplacedFolder);
  EXPECT_THAT(refusal(files), HasSubstr("would be replaced, and in it lies the truth"));
}

TEST_F(RunFilesTest, NoTwoOutputsAreOne) {
  Options live;
  live.output.json = "r.json";
  live.trace = "./r.json";
  EXPECT_THAT(refusal_of(Command::kLive, live),
              HasSubstr("--json r.json and --trace ./r.json are the same"));
  Options simulate;
  simulate.written = "d.pcap";
  simulate.output.json = "d.calibration.xml";
  EXPECT_THAT(refusal_of(Command::kSimulate, simulate), HasSubstr("are the same"));
  EXPECT_THAT(refusal_of(Command::kSegment, segment_of("s", "out", "out/000000.label")),
              HasSubstr("one of the frames"));
  Options segment = segment_of("s", "out", "out/r.json");
  segment.output.pcd = segment.output.png = "out";
  EXPECT_EQ(refusal_of(Command::kSegment, segment), "")
      << "files of several endings and a report go well together";
}

TEST_F(RunFilesTest, AnOutputIsWhatItsOptionNames) {
  make("file");
  fs::create_directory("folder");
  EXPECT_THAT(refusal_of(Command::kPlan, results_to("folder")),
              HasSubstr("--json folder is to be a file"));
  Options live;
  live.output.labels = "file";
  EXPECT_THAT(refusal_of(Command::kLive, live), HasSubstr("--labels file is to be a folder"));
  live.output.labels.clear();
  live.recorder.folder = "file";
  EXPECT_THAT(refusal_of(Command::kLive, live),
              HasSubstr("--recorder-folder file is to be a folder"));
  EXPECT_THAT(refusal_of(Command::kPlan, results_to("/dev/null")), HasSubstr("is to be a file"))
      << "root would replace the device";
  EXPECT_THAT(refusal_of(Command::kPlan, results_to("-")), HasSubstr("standard output"));
}

TEST_F(RunFilesTest, LabelsOfAnotherOriginAreNotMixedWithARuns) {
  make("d.truth/000000.label");
  EXPECT_THAT(refusal_of(Command::kReplay, replay_of("d.pcap", "d.truth", "")),
              AllOf(HasSubstr("--labels d.truth"), HasSubstr("000000.label")));
}

TEST_F(RunFilesTest, FramesOfAnotherInputAreNotTakenAway) {
  make("01/velodyne/000000.bin");
  make("d.pcap");
  fs::create_symlink("d.pcap", "link");
  const std::string capture = fs::absolute("d.pcap").lexically_normal().string();
  make("labels/000000.label");
  std::ofstream("labels/.label.terracut")
      << "of: " << fs::canonical(capture).string() << "\n000000.label\n";
  EXPECT_EQ(refusal_of(Command::kReplay, replay_of("./link", "labels", "")), "");
  EXPECT_THAT(refusal_of(Command::kSegment, segment_of("01", "labels", "")),
              AllOf(HasSubstr("--labels labels"), HasSubstr("d.pcap"), HasSubstr("--overwrite")));
  Options replay = replay_of("d.pcap", "labels", "");
  replay.capture.from = "192.168.1.201";
  EXPECT_THAT(refusal_of(Command::kReplay, replay), HasSubstr("d.pcap"))
      << "another sensor of that capture";
  replay.output.overwrite = true;
  EXPECT_EQ(refusal_of(Command::kReplay, replay), "");

  Options live;
  live.output.labels = "labels";
  std::vector<Error> unwritable;
  EXPECT_TRUE(claim_outputs(files_of(Command::kLive, live), &unwritable));
  ASSERT_EQ(unwritable.size(), 1u) << "a live run goes on without";
  EXPECT_THAT(unwritable[0].message, HasSubstr("d.pcap"));
}

TEST_F(RunFilesTest, TheSameInputIsTheSameByWhateverNameAndAsASequenceOrItsPoints) {
  make("01/velodyne/000000.bin");
  const auto made_of = [](const fs::path& scans) {
    return files_of(Command::kSegment, segment_of(scans, "", "")).made_of;
  };
  EXPECT_EQ(made_of("01"), made_of("./01/velodyne/"));
  Options compare;
  compare.compare.before = "a";
  compare.compare.after = "b";
  EXPECT_EQ(files_of(Command::kCompare, compare).made_of,
            fs::absolute("a").string() + " and " + fs::absolute("b").string());
}

TEST_F(RunFilesTest, WhatIsReplacedAsAWholeIsSaid) {
  EXPECT_EQ(replaced_by(files_of(Command::kReplay, replay_of("d.pcap", "", "r.json"))), "");
  make("r.json");
  EXPECT_EQ(replaced_by(files_of(Command::kReplay, replay_of("d.pcap", "", "r.json"))),
            "will be replaced: r.json");
  make("d.pcap");
  make("d.truth/000000.label");
  Options simulate;
  simulate.written = "d.pcap";
  EXPECT_EQ(replaced_by(files_of(Command::kSimulate, simulate)),
            "will be replaced: d.pcap, d.truth");
}

TEST_F(RunFilesTest, ARunWritesWhereNoOtherDoes) {
  const Options replay = replay_of("d", "labels", "r.json");
  const auto first = claim_outputs(files_of(Command::kReplay, replay));
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_THAT(refusal_of(Command::kReplay, replay),
              HasSubstr("--labels: labels: another run is writing it"));
  EXPECT_THAT(refusal_of(Command::kPlan, results_to("r.json")),
              HasSubstr("--json: r.json: another run is writing it"));
  EXPECT_EQ(refusal_of(Command::kPlan, results_to("other.json")), "");
}

TEST_F(RunFilesTest, WhatAKilledRunLeftIsRemovedByTheNext) {
  for (const char* name : {"labels/000003.label.part-77-1", "r.json.part-77-2", "d.pcap.part-77-3",
                           "d.truth.part-77-4/truth/000000.label", ".r.json.terracut-lock"}) {
    make(name);
  }
  make("labels/of.another.part-77-1");
  make("other.json.part-77-2");
  EXPECT_EQ(refusal_of(Command::kReplay, replay_of("d.pcap", "labels", "r.json")), "");
  Options simulate;
  simulate.written = "d.pcap";
  EXPECT_EQ(refusal_of(Command::kSimulate, simulate), "");
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(".")) {
    left.push_back(entry.path().string());
  }
  EXPECT_THAT(left, testing::UnorderedElementsAre("./labels", "./labels/of.another.part-77-1",
                                                  "./other.json.part-77-2"));
}

}  // namespace
}  // namespace terracut::cli
