// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/cli/live/live_run.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {

/// Live runs that hear sensors which play the test drive.
class CliLive : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "there is no /dev/shm";
  }
  /// A live run with these options on a port of its own.
  [[nodiscard]] LiveRun live(const std::string& options) const { return {folder_, options}; }
  /// One that has the calibration of the sensors below.
  [[nodiscard]] LiveRun live_with_table(const std::string& options) const {
    return live("--calibration " + quoted(kDriveCalibration) + " " + options);
  }
  /// A sensor at each of these addresses that sends to this run.
  [[nodiscard]] static Sensors sensors_at(std::vector<std::uint32_t> addresses, LiveRun& run) {
    return {addresses, {{Sensors::kAnyPort, run.port()}}, kDrive};
  }
  [[nodiscard]] static Sensors sensor(LiveRun& run) {
    return sensors_at({Sensors::kLocalhost}, run);
  }
  /// What `terracut dump` says of this run once that has heard its sensor.
  [[nodiscard]] Outcome dump_of(LiveRun& live_run) {
    EXPECT_TRUE(labels(live_run, 1));
    return run("dump " + LiveRun::name() + " --wait 60");
  }
  /// Waits until so many frames have labels.
  [[nodiscard]] static bool labels(LiveRun& run, std::uint64_t frames) {
    return run.shows([=](const auto& figures) { return LiveRun::labelled(figures) >= frames; });
  }
  /// A run that was interrupted: how many deadlines it met is the machine's affair.
  static void expect_good_end(const Outcome& outcome) {
    EXPECT_THAT(outcome.exit_code, testing::AnyOf(testing::Eq(kOk), testing::Eq(kDeadlinesMissed)))
        << outcome.err;
  }
};

}  // namespace terracut::cli
