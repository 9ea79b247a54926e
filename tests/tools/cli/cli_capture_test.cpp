// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Captures that are not what is expected, or lack something.
#include <sys/stat.h>

#include "cli_fixture.hpp"
#include "tests/support/rewritten_capture.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kInputRefused = 3, kNothingCameOut = 5;

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

class CliCapture : public Cli {
 protected:
  void expect_refusal(const std::string& arguments, int exit_code,
                      const testing::Matcher<const std::string&>& message) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << outcome.err;
    EXPECT_THAT(outcome.err, message) << arguments;
  }
  /// The drive's first packets, each changed.
  template <class Change>
  void write_capture(const std::string& name, std::size_t packets, Change change) const {
    test::rewrite_capture(kDrive, folder_ / name, [&](auto datagram, auto n, auto& write) {
      if (n >= packets) return;
      std::vector<std::uint8_t> payload(datagram.payload.begin(), datagram.payload.end());
      change(payload);
      datagram.payload = payload;
      write(datagram);
    });
  }
};

TEST_F(CliCapture, ThatIsAPipeIsRefusedByEveryCommand) {
  ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  for (const std::string command :
       {"replay fifo", "info fifo", "bench fifo", "view fifo", "calibrate fifo -o setup.yaml",
        "send fifo --to 127.0.0.1:9", "replay /dev/null"}) {
    expect_refusal(command, kInputRefused,
                   AllOf(HasSubstr("cannot be read twice; write it to a file first")));
  }
}

TEST_F(CliCapture, ThatIsTooShortForATableTakesTheOneBesideIt) {
  write_capture("short.pcap", 1500, [](const auto&) {});
  expect_refusal("replay short.pcap", kInputRefused,
                 HasSubstr("put it beside the capture as short.calibration.xml"));
  fs::copy_file(kDriveCalibration, folder_ / "short.calibration.xml");
  for (const std::string command :
       {"replay short.pcap --labels labels", "bench short.pcap --repeat 1"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("short.calibration.xml beside the capture is taken"));
  }
  EXPECT_THAT(run("info short.pcap").out, HasSubstr("short.calibration.xml beside the capture"));
  expect_done("replay short.pcap --labels given --calibration short.calibration.xml");
  EXPECT_EQ(content_of(folder_ / "labels/000000.label"),
            content_of(folder_ / "given/000000.label"));
  fs::copy_file(kDriveCalibration, folder_ / "short.calibration.yaml");
  expect_refusal("replay short.pcap", kInputRefused, HasSubstr("either might be meant"));
}

TEST_F(CliCapture, ThatHoldsItsTableIsReadByThatAndNotByOneBesideIt) {
  fs::copy_file(kDrive, folder_ / "d.pcap");
  write("d.calibration.xml", "no table");
  const Outcome outcome = run("replay d.pcap --duration 0.2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("beside")));
}

TEST_F(CliCapture, ThatBreaksOffIsWarnedOfOnce) {
  const std::string whole = content_of(kDrive);
  write("cut.pcap", whole.substr(0, whole.size() / 3));
  const Outcome outcome = run("replay cut.pcap --calibration " + quoted(kDriveCalibration));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(count_of("breaks off", outcome.out + outcome.err), 1U) << outcome.err;
}

TEST_F(CliCapture, OfInterfacesThatLibpcapCannotMixSaysHowToPartThem) {
  const auto little = [](std::uint32_t value) {
    return std::string{static_cast<char>(value), static_cast<char>(value >> 8),
                       static_cast<char>(value >> 16), static_cast<char>(value >> 24)};
  };
  const auto block = [&](std::uint32_t type, const std::string& body) {
    const std::string length = little(static_cast<std::uint32_t>(body.size() + 12));
    return little(type) + length + body + length;
  };
  const auto interface_of = [&](std::uint32_t link) { return block(1, little(link) + little(0)); };
  const std::string packet = little(1) + little(0) + little(0) + little(4) + little(4) + little(0);
  write("mixed.pcapng", block(0x0A0D0D0A, little(0x1A2B3C4D) + little(1) + little(0xFFFFFFFF) +
                                              little(0xFFFFFFFF)) +
                            interface_of(1) + interface_of(101) + block(6, packet));
  for (const std::string command : {"replay mixed.pcapng", "info mixed.pcapng"}) {
    expect_refusal(command, kInputRefused, HasSubstr("tshark -r FILE"));
  }
}

TEST_F(CliCapture, WithoutAReturnSaysSo) {
  write_capture("none.pcap", 700, [](auto& payload) {
    for (std::size_t block = 0; block < 12; ++block) {
      std::fill_n(payload.begin() + static_cast<std::ptrdiff_t>(block * 100 + 4), 96, 0);
    }
  });
  expect_refusal("replay none.pcap --mount-height 1.7 --calibration " + quoted(kDriveCalibration),
                 kNothingCameOut, HasSubstr("none holds a return"));
}

TEST_F(CliCapture, OfAnUnknownSensorSaysWhatMayBeDone) {
  write_capture("framed.pcap", 60, [](auto& payload) {
    payload.insert(payload.begin(), 8, 0);
    payload.insert(payload.end(), 4, 0);
  });
  expect_refusal("replay framed.pcap", kInputRefused,
                 AllOf(HasSubstr("60 datagrams of no sensor known here, 1218 bytes to port 2368"),
                       HasSubstr("8 bytes before and 4 behind"), HasSubstr("terracut segment"),
                       HasSubstr("terracut node")));
}

TEST_F(CliCapture, OfCutFramesSaysHowToRecordThem) {
  const std::string whole = content_of(kDrive);
  std::string cut = whole.substr(0, 24);
  for (std::size_t at = 24, i = 0; i < 60; ++i) {
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, &whole[at + 8], 4);
    cut += whole.substr(at, 8) + std::string("\x60\0\0\0", 4) + whole.substr(at + 12, 4 + 96);
    at += 16 + bytes;
  }
  write("cut.pcap", cut);
  expect_refusal("replay cut.pcap", kInputRefused, HasSubstr("tcpdump -s 0"));
  EXPECT_THAT(run("info cut.pcap").out, HasSubstr("tcpdump -s 0"));
}

}  // namespace
}  // namespace terracut::cli
