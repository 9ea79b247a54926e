// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut live` hears a disturbed stream of each sensor with everything switched on that its
// threads with a deadline have to do with. In a build with -fsanitize=realtime the program ends at
// their first call that may wait, with an exit code of its own; how fast it is, is not tested.
#include <ostream>

#include "live_run.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;
using testing::Not;

struct Scan {
  std::string sensor, returns;
  friend void PrintTo(const Scan& scan, std::ostream* out) {
    *out << scan.sensor << ", " << scan.returns;
  }
};

class LiveRealtime : public Cli, public testing::WithParamInterface<Scan> {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "there is no /dev/shm";
    expect_done("simulate --sensor " + GetParam().sensor + " --returns " + GetParam().returns +
                " --duration 0.7 --can-log -o drive.pcap");
    ASSERT_TRUE(fs::exists(folder_ / "drive.pcap"));
  }

  /// What `terracut live` did while a drive was sent to it: first as it is, until the threads label
  /// frames, then with every fault, then as it is again.
  [[nodiscard]] Outcome hear(const std::string& options) const {
    const std::string calibration =
        GetParam().sensor == "hdl64e" ? "drive.calibration.xml" : "drive.calibration.csv";
    LiveRun run(folder_, "--calibration " + calibration +
                             " --labels labels --json live.json --health-can nosuchcan1 " +
                             options);
    expect_frames(run);
    expect_done("send drive.pcap --to 127.0.0.1:" + std::to_string(run.port()) +
                " --loop 5 --faults 'loss@0.3s:20 reorder@0.5s:2 duplicate@0.7s:3 " +
                "burst@0.8s:50ms truncate@1s:3 clock@1.1s:+2s pause@1.3s:0.2s'");
    expect_frames(run);
    return run.interrupted();
  }
  /// Plays the drive until six frames more were judged.
  void expect_frames(LiveRun& run) const {
    const Sensors sensor({Sensors::kLocalhost}, {{Sensors::kAnyPort, run.port()}},
                         folder_ / "drive.pcap");
    std::uint64_t before = UINT64_MAX;
    EXPECT_TRUE(run.shows([&](const status::MonitorSnapshot& figures) {
      if (before == UINT64_MAX) before = figures.frames;
      return figures.frames >= before + 6;
    }));
  }
  [[nodiscard]] int count(const std::string& level) const {
    const auto frames = json("live.json").value("frames", nlohmann::json::object());
    return frames.value("levels", nlohmann::json::object()).value(level, 0);
  }
};

// With and without the vehicle's motion, by which points of the outputs are deskewed.

TEST_P(LiveRealtime, WholeMethodMakesNoCallThatMayWait) {
  const Outcome heard = hear("--deadline 10000");
  EXPECT_THAT(heard.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << heard.err;
  EXPECT_THAT(heard.err, Not(HasSubstr("RealtimeSanitizer")));
  EXPECT_GT(count("full"), 0);
  EXPECT_GT(files_in(folder_ / "labels", ".label"), 0U);
}

TEST_P(LiveRealtime, EveryOutputAtOnceMakesNoCallThatMayWait) {
  std::string outputs =
      "--stream 127.0.0.1:0 --view 127.0.0.1:0 --foxglove 127.0.0.1:0 --mcap drive.mcap";
#ifdef TERRACUT_HAS_DDS
  outputs += " --dds --dds-interface lo";
#endif
  const Outcome heard = hear("--deadline 10000 " + outputs);
  EXPECT_THAT(heard.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << heard.err;
  EXPECT_THAT(heard.err, Not(HasSubstr("RealtimeSanitizer")));
  EXPECT_GT(count("full"), 0);
  EXPECT_GT(fs::file_size(folder_ / "drive.mcap"), 1'000'000U);
}

TEST_P(LiveRealtime, DeadlineThatCannotBeMetMakesNoCallThatMayWaitEither) {
  fs::create_directory(folder_ / "dumps");
  const Outcome heard =
      hear("--deadline 1 --recorder-folder dumps --can nosuchcan0 --dbc drive.can.dbc");
  EXPECT_EQ(heard.exit_code, kDeadlinesMissed) << heard.err;
  EXPECT_THAT(heard.err, Not(HasSubstr("RealtimeSanitizer")));
  EXPECT_GT(count("skipped") + count("coarse") + count("cut_stopped"), 0);
}

INSTANTIATE_TEST_SUITE_P(BothSensors, LiveRealtime,
                         testing::Values(Scan{"hdl64e", "single"}, Scan{"ruby128", "dual"}),
                         [](const auto& scan) { return scan.param.sensor; });

}  // namespace
}  // namespace terracut::cli
