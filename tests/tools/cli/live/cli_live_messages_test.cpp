// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What becomes of a live run whose messages nobody takes.
#include <fcntl.h>
#include <sys/stat.h>

#include "rt/files/owned_descriptor.hpp"
#include "tests/tools/cli/live/cli_live.hpp"

namespace terracut::cli {
namespace {

class CliLiveMessages : public CliLive {
 protected:
  /// A run whose messages go to `there`; its standard error is open elsewhere, so that it is known
  /// when it ends.
  [[nodiscard]] LiveRun saying_to(const std::string& there) const {
    return live("--calibration " + quoted(kDriveCalibration) + " --json live.json 9>&2 2>" + there);
  }
  /// Where it listens, by its page.
  [[nodiscard]] static std::uint16_t port_of(LiveRun& run) {
    std::string input;
    EXPECT_TRUE(run.shows([&](const auto& figures) {
      input = figures.input.view();
      return !input.empty();
    }));
    return static_cast<std::uint16_t>(std::stoi(input.substr(input.rfind(':') + 1)));
  }
  static Sensors sensor_of(LiveRun& run) {
    return {{Sensors::kLocalhost}, {{Sensors::kAnyPort, port_of(run)}}, kDrive};
  }
};

TEST_F(CliLiveMessages, ThatCannotBeWrittenEndNothing) {
  LiveRun run = saying_to("/dev/full");
  const Sensors sender = sensor_of(run);
  EXPECT_TRUE(labels(run, 3));
  expect_good_end(run.interrupted());
}

TEST_F(CliLiveMessages, ThatNobodyReadsHoldUpNothing) {
  // A pipe that is full, whose reader does not read: whoever writes to it waits for ever.
  const fs::path pipe = folder_ / "full.pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const files::OwnedDescriptor reader(::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ASSERT_TRUE(reader);
  const std::string some(4096, '.');
  while (::write(reader.get(), some.data(), some.size()) > 0) {
  }
  LiveRun run = saying_to(quoted(pipe));
  {
    const Sensors sender = sensor_of(run);
    EXPECT_TRUE(labels(run, 3));
  }
  // It wants to say this, too, and goes on.
  EXPECT_TRUE(run.shows([](const auto& figures) { return figures.silences > 0; }));
  expect_good_end(run.interrupted());
  EXPECT_GE(json("live.json")["frames"]["count"], 3);
}

}  // namespace
}  // namespace terracut::cli
