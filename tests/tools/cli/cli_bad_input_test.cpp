// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the program says of wrong command lines and bad inputs, and with which exit code.
#include "cli_fixture.hpp"
#include "tests/support/places.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

/// terracut's exit codes, as documented by `terracut --help`.
constexpr int kUsage = 2, kInputRefused = 3, kOutputFailed = 4, kNothingCameOut = 5;

const fs::path kCaptures = test::shared_data("pcap");
const fs::path kCalibrations = test::shared_data("calib");

class CliRefusal : public Cli {
 protected:
  template <class Message>
  void expect_refusal(const std::string& arguments, int exit_code, const Message& message) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("error: "), message)) << arguments;
  }
};

TEST_F(CliRefusal, OfAWrongCommandLineNamesItsSubject) {
  expect_refusal("replay x.pcap --lables l", kUsage,
                 HasSubstr("replay has no option --lables (did you mean --labels?)"));
  expect_refusal("simulate", kUsage, HasSubstr("nothing to do"));
  expect_refusal("replay x.pcap --truth t --start 1", kUsage, HasSubstr("--truth"));
}

TEST_F(CliRefusal, OfFilesThatAreNoCaptureNamesThem) {
  write("empty.pcap", "");
  write("text.pcap", "This is not a capture, it only says so.\n");
  expect_refusal("replay none.pcap", kInputRefused,
                 AllOf(HasSubstr("none.pcap"), HasSubstr("no such file")));
  expect_refusal("replay empty.pcap", kInputRefused,
                 AllOf(HasSubstr("empty.pcap"), HasSubstr("is empty")));
  expect_refusal("replay text.pcap", kInputRefused,
                 AllOf(HasSubstr("text.pcap"), HasSubstr("not a capture")));
  expect_refusal("replay .", kInputRefused, HasSubstr("folder"));
  for (const std::string command : {"info", "bench"}) {
    expect_refusal(command + " none.pcap", kInputRefused, HasSubstr("no such file"));
  }
}

TEST_F(CliRefusal, OfWhatAViewIsToBeComparedWithNamesIt) {
  const std::string view = "view " + quoted(kDrive) + " --at 127.0.0.1:0 ";
  expect_refusal(view + "--truth none", kInputRefused,
                 AllOf(HasSubstr("--truth none"), HasSubstr("NNNNNN.label")));
  expect_refusal(view + "--truth .", kInputRefused, HasSubstr("NNNNNN.label"));
  expect_refusal(view + "--beside none.yaml", kInputRefused,
                 AllOf(HasSubstr("none.yaml"), HasSubstr("no such file")));
  write("b.yaml", "method: {profle: paper}\n");
  expect_refusal(view + "--beside b.yaml", kInputRefused, HasSubstr("method.profle"));
  fs::create_directory(folder_ / "other.truth");
  write("other.truth/000000.label", "8 bytes!");
  expect_refusal(view + "--truth other.truth", kInputRefused, HasSubstr("000000.label"));
}

TEST_F(CliRefusal, WithoutACalibrationSaysHowMuchIsMissingAndWhatToDo) {
  const std::string whole = content_of(kDrive);
  write("short.pcap", whole.substr(0, whole.size() / 3));
  expect_refusal(
      "replay short.pcap", kInputRefused,
      AllOf(HasSubstr("no calibration"), HasSubstr("missing"), HasSubstr("--calibration")));
}

TEST_F(CliRefusal, OfAnotherSensorsCalibrationNamesTheFile) {
  expect_refusal(
      "simulate --sensor ruby128 --calibration " + quoted(kDriveCalibration) + " -o x.pcap",
      kInputRefused, HasSubstr("drive.calibration.xml"));
  EXPECT_FALSE(fs::exists(folder_ / "x.pcap"));
}

TEST_F(CliRefusal, OfAnUnusableCalibrationNamesTheFile) {
  write("broken.xml", "<boost_serialization><DB>");
  expect_refusal("replay " + quoted(kDrive) + " --calibration broken.xml", kInputRefused,
                 HasSubstr("broken.xml"));
  expect_refusal("replay " + quoted(kDrive) + " --calibration none.xml", kInputRefused,
                 HasSubstr("none.xml"));
  expect_refusal("replay " + quoted(kDrive) + " --setup " + quoted(kDriveCalibration),
                 kInputRefused, HasSubstr("calibration.xml"));
}

TEST_F(CliRefusal, OfACaptureWithoutWantedPacketsSaysWhereTheyWent) {
  expect_refusal("replay " + quoted(kDrive) + " --port 99", kInputRefused,
                 AllOf(HasSubstr("another port"), HasSubstr("terracut info")));
  expect_refusal("replay " + quoted(kDrive) + " --from 1.2.3.4", kInputRefused,
                 HasSubstr("another address"));
  expect_refusal("replay " + quoted(kDrive) + " --start 1000", kNothingCameOut,
                 HasSubstr("ends before --start"));
}

TEST_F(CliRefusal, OfOutputsThatCannotBeWrittenNamesThem) {
  write("file", "in the way");
  const std::string replay =
      "replay " + quoted(kDrive) + " --duration 0.2 --calibration " + quoted(kDriveCalibration);
  expect_refusal(replay + " --json file/report.json", kOutputFailed,
                 HasSubstr("--json: cannot write file: it is a file"));
  for (const std::string option : {"--labels", "--pcd", "--png"}) {
    expect_refusal(replay + " " + option + " file", kOutputFailed,
                   HasSubstr(option + " file is to be a folder"));
  }
  expect_refusal("simulate --duration 0.1 -o file/x.pcap", kOutputFailed, HasSubstr("file"));
  EXPECT_EQ(content_of(folder_ / "file"), "in the way");
}

TEST_F(CliRefusal, OfOutputsThatAreInputsComesBeforeAnyWork) {
  fs::copy_file(kDrive, folder_ / "d.pcap");
  const auto size = fs::file_size(kDrive);
  for (const std::string arguments :
       {"replay d.pcap --json d.pcap", "info d.pcap --json ./d.pcap", "calibrate d.pcap -o d.pcap",
        "bench d.pcap --json d.pcap", "send d.pcap --to 127.0.0.1:9 --json d.pcap"}) {
    expect_refusal(arguments, kUsage, HasSubstr("is the capture that the run reads (FILE d.pcap)"));
  }
  write("c.yaml", "output:\n  json: c.yaml\n");
  expect_refusal("replay d.pcap --config c.yaml", kUsage, HasSubstr("the configuration"));
  EXPECT_EQ(fs::file_size(folder_ / "d.pcap"), size);
}

TEST_F(CliRefusal, OfAnEmptyValueNamesTheOption) {
  expect_refusal("replay x.pcap --labels ''", kUsage, HasSubstr("--labels"));
}

TEST_F(CliRefusal, OfOtherSensorsNamesTheirModel) {
  if (!fs::exists(kCaptures)) GTEST_SKIP() << "no captures at " << kCaptures;
  for (const auto& entry : fs::directory_iterator(kCaptures)) {
    const std::string capture = quoted(entry.path());
    const std::string with_table = " --calibration " + quoted(kDriveCalibration);
    expect_refusal("replay " + capture + with_table, kInputRefused, HasSubstr("is built in"));
    for (const std::string option : {" --sensor hdl64e", " --sensor ruby128"}) {
      expect_refusal(
          "replay " + capture + option, kInputRefused,
          AnyOf(HasSubstr("packets of a Velodyne V"), HasSubstr("packets of a Velodyne HDL-32E")));
    }
    const Outcome info = run("info " + capture);
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_THAT(info.out, HasSubstr("Velodyne"));
  }
}

TEST_F(CliRefusal, OfAnotherSensorsCalibrationNamesIt) {
  if (!fs::exists(kCalibrations)) GTEST_SKIP() << "no calibrations at " << kCalibrations;
  expect_refusal(
      "replay " + quoted(kDrive) + " --calibration " + quoted(kCalibrations / "rs32-angle.csv"),
      kInputRefused, AllOf(HasSubstr("rs32-angle.csv"), HasSubstr("RoboSense")));
}

TEST_F(CliRefusal, DoesNotBefallACaptureThatBreaksOff) {
  const std::string whole = content_of(kDrive);
  write("cut.pcap", whole.substr(0, whole.size() / 2));
  const Outcome outcome =
      run("replay cut.pcap --json report.json --calibration " + quoted(kDriveCalibration));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning"), HasSubstr("breaks off")));
  const auto report = json("report.json");
  EXPECT_TRUE(report.contains("input_warning"));
  EXPECT_GE(report["summary"]["complete_frames"], 5);
  EXPECT_EQ(report["summary"]["returns_in"], report["summary"]["returns_labelled"]);
}

TEST_F(CliRefusal, IsAWarningWhenThePacketsCarryAnotherTable) {
  std::string table = content_of(kDriveCalibration);
  const std::size_t at = table.find("<rotCorrection_>");
  ASSERT_NE(at, std::string::npos);
  table.replace(at + 16, table.find('<', at + 16) - at - 16, "1.25");
  write("other.xml", table);
  const Outcome outcome = run("replay " + quoted(kDrive) + " --calibration other.xml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning"), HasSubstr("another calibration")));
}

}  // namespace
}  // namespace terracut::cli
