// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut replay --can`: the vehicle's motion, recorded beside a capture, removed from its
// frames.
#include "cli_fixture.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Eq;
using testing::HasSubstr;

class CliMotion : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    expect_done(
        "simulate --scene flat --duration 0.6 --speed 20 --yaw-rate 28 --can-log -o d.pcap");
  }
  [[nodiscard]] static std::string replay(const std::string& options) {
    return "replay d.pcap --calibration d.calibration.xml --json report.json " + options;
  }
  [[nodiscard]] std::vector<bool> deskewed() const {
    const nlohmann::json report = json("report.json");
    std::vector<bool> deskewed;
    for (const auto& frame : report.at("frames")) {
      deskewed.push_back(frame.at("deskewed").get<bool>());
    }
    return deskewed;
  }
};

TEST_F(CliMotion, EveryFrameIsDeskewed) {
  expect_done(replay("--pcd seen"));
  EXPECT_FALSE(json("report.json").at("summary").contains("motion"));
  expect_done(replay("--can d.can.log --dbc d.can.dbc --pcd freed"));
  EXPECT_THAT(deskewed(), AllOf(testing::SizeIs(6), Each(Eq(true))));
  const auto motion = json("report.json").at("summary").at("motion");
  EXPECT_EQ(motion.at("deskewed_frames"), 6);
  EXPECT_GT(motion.at("samples").get<int>(), 50);
  EXPECT_GT(motion.at("newest_sample_after_frame_ms").at("min").get<double>(), -20.0);
  EXPECT_NE(content_of(folder_ / "seen" / "000003.pcd"),
            content_of(folder_ / "freed" / "000003.pcd"));
}

TEST_F(CliMotion, MovesPointsToTheInstantThatIsAskedFor) {
  expect_done(replay("--can d.can.log --dbc d.can.dbc --pcd end"));
  expect_done(replay("--can d.can.log --dbc d.can.dbc --pcd start --deskew-to start"));
  EXPECT_NE(content_of(folder_ / "end" / "000003.pcd"),
            content_of(folder_ / "start" / "000003.pcd"));
}

TEST_F(CliMotion, IsNotMadeUpBehindTheEndOfItsRecording) {
  const std::string log = content_of(folder_ / "d.can.log");
  write("short.log", log.substr(0, log.rfind('\n', log.size() / 2) + 1));
  expect_done(replay("--pcd seen"));
  expect_done(replay("--can short.log --dbc d.can.dbc --pcd freed"));
  const auto frames = deskewed();
  EXPECT_TRUE(frames.front());
  EXPECT_FALSE(frames.back());
  EXPECT_EQ(content_of(folder_ / "seen" / "000005.pcd"),
            content_of(folder_ / "freed" / "000005.pcd"))
      << "as the sensor saw it";
}

TEST_F(CliMotion, ThatIsNotInTheRecordingIsRefusedBeforeAnythingIsDecoded) {
  write("other.log", "(1700000000.000000) can0 7FF#00\n");
  for (const auto& [log, reason] :
       {std::pair{"other.log", "none of its 1 frames"}, std::pair{"d.can.dbc", "no frame in"}}) {
    const Outcome outcome = run(replay(std::string("--dbc d.can.dbc --can ") + log));
    EXPECT_EQ(outcome.exit_code, kInputRefused);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(log), HasSubstr(reason)));
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "report.json"));
  }
}

TEST_F(CliMotion, OfAnotherTimeIsNoSuccess) {
  write("old.log", "(1000000000.000000) can0 1A0#0E10000000000000\n");
  const Outcome outcome = run(replay("--can old.log --dbc d.can.dbc"));
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("old.log"), HasSubstr("none of the 6 frames")));
  EXPECT_THAT(outcome.out, HasSubstr("6 without ego motion"))
      << "the labels are there all the same";
}

TEST_F(CliMotion, OfUnreadableOrMissingFilesIsRefusedByName) {
  const Outcome log = run(replay("--can none.log --dbc d.can.dbc"));
  EXPECT_EQ(log.exit_code, kInputRefused);
  EXPECT_THAT(log.err, HasSubstr("none.log"));
  const Outcome dbc = run(replay("--can d.can.log --dbc none.dbc"));
  EXPECT_EQ(dbc.exit_code, kInputRefused);
  EXPECT_THAT(dbc.err, HasSubstr("none.dbc"));
  write("other.dbc", "BO_ 291 OTHER: 8 ECU\n SG_ OTHER : 0|8@1+ (1,0) [0|0] \"\" ECU\n");
  const Outcome signal = run(replay("--can d.can.log --dbc other.dbc"));
  EXPECT_THAT(signal.err, HasSubstr("SPEED"));
  EXPECT_THAT(run(replay("--can d.can.log")).err, HasSubstr("--dbc"));
  EXPECT_THAT(run(replay("--dbc d.can.dbc")).err, HasSubstr("--can"));
}

}  // namespace
}  // namespace terracut::cli
