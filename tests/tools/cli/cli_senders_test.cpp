// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Captures that more than one machine sent into.
#include <functional>

#include "cli_fixture.hpp"
#include "tests/support/rewritten_capture.hpp"

namespace terracut::cli {
namespace {

using packet::Datagram;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kUsage = 2;
constexpr std::uint32_t kOther = 0x0A'00'00'07;  // 10.0.0.7

class CliSenders : public Cli {
 protected:
  /// The drive, and beside each of its datagrams those of another sender, if `is_sent(number)`.
  void write_capture(const std::string& name,
                     const std::function<bool(std::size_t)>& is_sent) const {
    test::rewrite_capture(kDrive, folder_ / name, [&](auto datagram, auto number, auto& write) {
      write(datagram);
      datagram.source_address = kOther;
      if (is_sent(number)) write(datagram);
    });
  }
  /// The drive, and by turns with its packets those of a sensor whose head and clock are ahead, or
  /// the same ones, on a way of their own.
  void write_two(const std::string& name, std::size_t ahead,
                 const std::function<void(Datagram&)>& lead) const {
    auto later = capture::CaptureSource::open(kDrive);
    ASSERT_TRUE(later);
    for (std::size_t i = 0; i < ahead; ++i) ASSERT_TRUE(*later->next());
    test::rewrite_capture(kDrive, folder_ / name, [&](const auto& first, auto, auto& write) {
      const auto second = *later->next();
      if (!second) return;
      Datagram datagram = *second;
      datagram.stamp_ns = first.stamp_ns;
      lead(datagram);
      write(first);
      write(datagram);
    });
  }
  [[nodiscard]] static std::string with_calibration(const std::string& arguments) {
    return arguments + " --duration 0.35 --calibration " + quoted(kDriveCalibration);
  }
  void expect_labels_of_the_drive(const std::string& folder) const {
    expect_done(with_calibration("replay " + quoted(kDrive) + " --labels alone"));
    for (const char* name : {"000000.label", "000001.label", "000002.label"}) {
      EXPECT_EQ(content_of(folder_ / folder / name), content_of(folder_ / "alone" / name)) << name;
    }
  }
};

TEST_F(CliSenders, OfTwoSensorsAreRefusedByNameUntilOneIsChosen) {
  write_capture("two.pcap", [](std::size_t) { return true; });
  for (const std::string command :
       {"replay two.pcap", "bench two.pcap", "calibrate two.pcap -o setup.yaml"}) {
    const Outcome outcome = run(with_calibration(command));
    EXPECT_EQ(outcome.exit_code, kUsage) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("several sensors"), HasSubstr("at 10.0.0.7, "),
                                   HasSubstr("choose one with --from")));
  }
  expect_done(with_calibration("replay two.pcap --from 10.0.0.7 --labels chosen"));
  expect_labels_of_the_drive("chosen");
}

TEST_F(CliSenders, OfTwoSensorsBehindOneAddressAreRefusedUntilOneIsChosen) {
  struct Case {
    std::function<void(Datagram&)> lead;
    std::string first, second;
  };
  for (const auto& [lead, first, second] :
       {Case{[](Datagram& datagram) { datagram.destination_port = 2369; }, "--port 2368",
             "--port 2369"},
        Case{[](Datagram& datagram) { datagram.destination_address = kOther; },
             "--to 192.168.3.255", "--to 10.0.0.7"},
        Case{[](Datagram& datagram) { datagram.source_port = 4444; }, "--from 192.168.3.43:443",
             "--from 192.168.3.43:4444"}}) {
    write_two("two.pcap", 300, lead);
    for (const std::string command : {"replay two.pcap", "bench two.pcap",
                                      "calibrate two.pcap -o setup.yaml", "view two.pcap"}) {
      const Outcome outcome = run(with_calibration(command));
      EXPECT_EQ(outcome.exit_code, kUsage) << outcome.err;
      EXPECT_THAT(outcome.err,
                  AllOf(HasSubstr("several sensors"), HasSubstr(first), HasSubstr(second)));
    }
    EXPECT_THAT(run("info two.pcap").out, AllOf(HasSubstr(first), HasSubstr(second)));
    expect_done(with_calibration("replay two.pcap --labels chosen --overwrite " + first));
    expect_labels_of_the_drive("chosen");
    expect_done(with_calibration("replay two.pcap --labels other --overwrite " + second));
  }
}

TEST_F(CliSenders, OfOneSensorThatIsHeardTwiceAreOneSensors) {
  write_two("twice.pcap", 0, [](Datagram& datagram) { datagram.destination_address = kOther; });
  const Outcome outcome = run(with_calibration("replay twice.pcap --labels labels"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("rejected_repeated"));
  expect_labels_of_the_drive("labels");
}

TEST_F(CliSenders, OfASensorThatJoinsLaterAreLeftOutAndCounted) {
  std::vector<std::uint8_t> earlier;
  test::rewrite_capture(kDrive, folder_ / "joins.pcap", [&](auto datagram, auto n, auto& write) {
    write(datagram);
    if (n == 3000) earlier.assign(datagram.payload.begin(), datagram.payload.end());
    if (n != 4000) return;
    datagram.payload = earlier;  // no copy of what was just sent
    datagram.destination_port = 2369;
    write(datagram);
  });
  const Outcome outcome = run("replay joins.pcap --json report.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: 1 data packets of 192.168.3.43 are not of the "
                                     "sensor that sends to 192.168.3.255:2368"));
  EXPECT_EQ(json("report.json")["summary"]["datagrams"]["other_stream"], 1);
}

TEST_F(CliSenders, OfStrayPacketsAreLeftOutAndCounted) {
  write_capture("stray.pcap", [](std::size_t number) { return number == 100; });
  const Outcome outcome = run(with_calibration("replay stray.pcap --labels labels"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: 1 datagrams came from other addresses"));
  expect_labels_of_the_drive("labels");
}

}  // namespace
}  // namespace terracut::cli
