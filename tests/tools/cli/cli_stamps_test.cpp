// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Captures whose stamps do not advance as packets do: the recording machine's clock was set.
#include <functional>

#include "cli_fixture.hpp"
#include "tests/support/rewritten_capture.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class CliStamps : public Cli {
 protected:
  /// The drive with every stamp shifted by `shift_ns(number of the packet)`; how many there are.
  std::size_t write_capture(const std::string& name,
                            const std::function<std::int64_t(std::size_t)>& shift_ns) const {
    return test::rewrite_capture(kDrive, folder_ / name, [&](auto datagram, auto n, auto& write) {
      datagram.stamp_ns += shift_ns(n);
      write(datagram);
    });
  }
  [[nodiscard]] std::string labels_in(const std::string& folder) const {
    std::string all;
    for (std::size_t i = 0; i < kDriveFrames; ++i) {
      all += content_of(folder_ / folder /
                        ("00000" + std::to_string(i) + ".label").substr(i < 10 ? 0 : 1));
    }
    return all;
  }
  [[nodiscard]] std::string replay(const std::string& capture, const std::string& options) const {
    return "replay " + capture + " --calibration " + quoted(kDriveCalibration) + " " + options;
  }
  /// Of a replay's report, that each record of the capture is in one place.
  static void expect_all_counted(const nlohmann::json& report, std::size_t packets) {
    const nlohmann::json& datagrams = report["summary"]["datagrams"];
    ASSERT_TRUE(datagrams.is_object()) << report.dump(1);
    std::size_t sum = 0;
    for (const auto& [name, count] : datagrams.items()) {
      if (name != "read") sum += count.get<std::size_t>();
    }
    EXPECT_EQ(datagrams["read"], packets) << datagrams.dump();
    EXPECT_EQ(sum, packets) << datagrams.dump();
  }
};

TEST_F(CliStamps, AreNoReasonToLeaveAPacketOut) {
  expect_done(replay(quoted(kDrive), "--labels recorded"));
  const std::string as_recorded = labels_in("recorded");
  const std::vector<std::function<std::int64_t(std::size_t)>> clocks{
      [](std::size_t number) { return number < 2000 ? 0 : -2 * kSecond_ns; },
      [](std::size_t number) { return number < 2000 ? 3600 * kSecond_ns : 0; },
      [](std::size_t number) { return number == 0 ? 3600 * kSecond_ns : 0; },
      [](std::size_t number) { return number == 2000 ? 3600 * kSecond_ns : 0; },
      [](std::size_t number) { return static_cast<std::int64_t>(number) * -kSecond_ns; }};
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    const std::size_t packets = write_capture("odd.pcap", clocks[i]);
    const Outcome outcome = run(replay("odd.pcap", "--labels labels --json report.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("warning: odd.pcap: the stamps step back ")) << i;
    EXPECT_EQ(labels_in("labels"), as_recorded) << i;
    expect_all_counted(json("report.json"), packets);
  }
}

TEST_F(CliStamps, SetBackAreStillTimeForStartAndDuration) {
  const std::size_t packets = write_capture(
      "back.pcap", [](std::size_t number) { return number < 2000 ? 0 : -2 * kSecond_ns; });
  const std::string part = "--start 0.4 --duration 0.5 --json report.json";
  const Outcome outcome = run(replay("back.pcap", part));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(" datagrams before --start"));
  const nlohmann::json back = json("report.json")["summary"];
  expect_done(replay(quoted(kDrive), part));
  const nlohmann::json recorded = json("report.json")["summary"];
  EXPECT_EQ(back["frames"], recorded["frames"]);
  EXPECT_NEAR(back["datagrams"]["decoded"].get<double>(),
              recorded["datagrams"]["decoded"].get<double>(), 2);
  EXPECT_GT(recorded["datagrams"]["before_start"], 1000);
  EXPECT_GT(recorded["datagrams"]["behind_end"], 0);
  EXPECT_LT(recorded["datagrams"]["read"], packets);
  expect_all_counted(json("report.json"), recorded["datagrams"]["read"].get<std::size_t>());
}

TEST_F(CliStamps, OfARecordingInOrderAreNotMentioned) {
  const Outcome outcome = run(replay(quoted(kDrive), "--json report.json"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("step back")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("left out")));
}

}  // namespace
}  // namespace terracut::cli
