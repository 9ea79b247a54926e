// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut live` hears what `terracut send` plays. How fast is not tested: a machine may be busy.
#include <filesystem>
#include <thread>

#include "cli_fixture.hpp"
#include "firmware_io/live/udp_source.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;

class CliLive : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    // A port that was free a moment ago.
    rt::FixedMemory memory;
    auto source = firmware_io::UdpSource::open({}, memory);
    ASSERT_TRUE(source) << source.error().message;
    port_ = std::to_string(source->local().port);
  }
  [[nodiscard]] std::string live(const std::string& options) const {
    return "live --listen 127.0.0.1:" + port_ + " --metrics off --no-lock-memory --name test-" +
           port_ + " --deadline-ms 10000 " + options;
  }
  [[nodiscard]] std::string send(const std::string& options) const {
    return "send " + quoted(kDrive) + " --to 127.0.0.1:" + port_ + " " + options;
  }
  std::string port_;
};

TEST_F(CliLive, LabelsWhatIsSentToIt) {
  Outcome heard;
  std::thread listener([&] {
    heard = run(live("--duration 4 --calibration " + quoted(kDriveCalibration) +
                     " --labels labels --json live.json --trace trace.json"));
  });
  const Outcome sent = run(send("--loop 4"));
  listener.join();
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_THAT(heard.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << heard.err;
  EXPECT_THAT(heard.err, HasSubstr("HDL-64E"));
  const auto summary = json("live.json");
  EXPECT_GT(summary.at("frames").at("count").get<int>(), 5);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "labels")) {
    EXPECT_GT(entry.file_size(), 0U);
    ++files;
  }
  EXPECT_GT(files, 3);
  EXPECT_TRUE(json("trace.json").contains("traceEvents"));
}

TEST_F(CliLive, SaysWhatItHeardInsteadOfASensor) {
  const Outcome outcome = run(live("--calibration " + quoted(kDriveCalibration)));
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("no data packets"));
}

TEST_F(CliLive, NamesAPortThatIsTaken) {
  rt::FixedMemory memory;
  const auto taken = firmware_io::UdpSource::open({}, memory);
  ASSERT_TRUE(taken);
  const Outcome outcome =
      run("live --listen 0.0.0.0:" + std::to_string(taken->local().port) + " --metrics off");
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("port"));
}

}  // namespace
}  // namespace terracut::cli
