// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut live` hears a disturbed stream of each sensor with everything switched on that its
// threads with a deadline have to do with. In a build with -fsanitize=realtime the program ends at
// their first call that may wait, with an exit code of its own; how fast it is, is not tested.
#include <cstdlib>
#include <ostream>

#include "cli_fixture.hpp"
#include "firmware_io/live/udp_source.hpp"
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
    rt::FixedMemory memory;
    auto source = firmware_io::UdpSource::open({}, memory);  // a port that was free a moment ago
    ASSERT_TRUE(source) << source.error().message;
    port_ = std::to_string(source->local().port);
    expect_done("simulate --sensor " + GetParam().sensor + " --returns " + GetParam().returns +
                " --duration 0.7 --can-log -o drive.pcap");
    ASSERT_TRUE(fs::exists(folder_ / "drive.pcap"));
  }

  /// What `terracut live` did while a disturbed drive was sent to it, until it had enough.
  [[nodiscard]] Outcome hear(const std::string& options) const {
    const std::string program = quoted(TERRACUT_PROGRAM);
    const std::string calibration =
        GetParam().sensor == "hdl64e" ? "drive.calibration.xml" : "drive.calibration.csv";
    const std::string send = program + " send drive.pcap --to 127.0.0.1:" + port_ +
                             " --loop 0 --faults 'loss@1.6s:20 reorder@1.8s:2 duplicate@2s:3 " +
                             "burst@2.1s:50ms truncate@2.3s:3 clock@2.4s:+2s pause@2.6s:0.2s'";
    const std::string live =
        program + " live --listen 127.0.0.1:" + port_ +
        " --metrics off --no-lock-memory --name rt-" + port_ + " --duration 3 --calibration " +
        calibration + " --labels labels --json live.json " +
        "--can nosuchcan0 --dbc drive.can.dbc --health-can nosuchcan1 " + options;
    const std::string script = "cd " + quoted(folder_) + " || exit 1; " + send +
                               " >sent.txt 2>&1 & sender=$!; " + live +
                               " >heard.txt 2>&1; code=$?; kill $sender; wait $sender; exit $code";
    const int status = std::system(script.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder_ / "sent.txt"),
            content_of(folder_ / "heard.txt")};
  }
  [[nodiscard]] int count(const std::string& rung) const {
    const auto frames = json("live.json").value("frames", nlohmann::json::object());
    return frames.value("rungs", nlohmann::json::object()).value(rung, 0);
  }

  std::string port_;
};

TEST_P(LiveRealtime, WholeMethodMakesNoCallThatMayWait) {
  const Outcome heard = hear("--deadline-ms 10000");
  EXPECT_THAT(heard.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << heard.err << heard.out;
  EXPECT_THAT(heard.err, Not(HasSubstr("RealtimeSanitizer")));
  EXPECT_GT(count("full"), 0);
  EXPECT_GT(files_in(folder_ / "labels", ".label"), 0U);
}

TEST_P(LiveRealtime, DeadlineThatCannotBeMetMakesNoCallThatMayWaitEither) {
  fs::create_directory(folder_ / "dumps");
  const Outcome heard = hear("--deadline-ms 1 --recorder-folder dumps");
  EXPECT_EQ(heard.exit_code, kDeadlinesMissed) << heard.err << heard.out;
  EXPECT_THAT(heard.err, Not(HasSubstr("RealtimeSanitizer")));
  EXPECT_GT(count("skipped") + count("coarse") + count("cut_stopped"), 0);
}

INSTANTIATE_TEST_SUITE_P(BothSensors, LiveRealtime,
                         testing::Values(Scan{"hdl64e", "single"}, Scan{"ruby128", "dual"}),
                         [](const auto& scan) { return scan.param.sensor; });

}  // namespace
}  // namespace terracut::cli
