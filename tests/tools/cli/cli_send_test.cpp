// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut send` as a sensor: what it says it sent is what comes.
#include <algorithm>
#include <optional>

#include "background_program.hpp"
#include "firmware_io/net/udp_source.hpp"
#include "firmware_io/sensor/hdl64e_survey.hpp"
#include "tests/support/rewritten_capture.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using net::UdpSource;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint32_t kLocalhost = 0x7F000001;

class CliSend : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    auto source = UdpSource::open({.sender = net::Sender{kLocalhost}}, memory_);
    ASSERT_TRUE(source) << source.error().message;
    source_.emplace(*std::move(source));
  }
  [[nodiscard]] std::string to() const {
    return " --to 127.0.0.1:" + std::to_string(source_->local().port);
  }

  /// Every 40th packet of the drive as a capture: the smallest receive buffer there is holds them
  /// all, however late they are read.
  [[nodiscard]] fs::path sparse_drive() const {
    const fs::path sparse = folder_ / "sparse.pcap";
    test::rewrite_capture(kDrive, sparse, [](const auto& datagram, auto n, auto& write) {
      if (n % 40 == 0) write(datagram);
    });
    return sparse;
  }
  /// Takes what comes until that is so many datagrams, with those the kernel says it dropped.
  void receive(std::uint64_t datagrams) {
    while (source_->counters().received + source_->counters().kernel_drops < datagrams) {
      for (const auto& each : source_->receive(10'000'000)) {
        payloads_.emplace_back(each.payload.begin(), each.payload.end());
      }
      source_->refresh_drops();
    }
    EXPECT_EQ(source_->counters().received + source_->counters().kernel_drops, datagrams);
  }

  /// Waits for something to come.
  void receive_one() {
    while (source_->receive(10'000'000).empty()) {
    }
  }

  memory::FixedMemory memory_;
  std::optional<UdpSource> source_;
  std::vector<std::vector<std::uint8_t>> payloads_;
};

TEST_F(CliSend, SendsTheDatagramsOfACaptureAsTheyAre) {
  const fs::path drive = sparse_drive();
  auto capture = capture::CaptureSource::open(drive);
  ASSERT_TRUE(capture);
  std::vector<std::vector<std::uint8_t>> expected;
  while (const auto next = *capture->next()) {
    expected.emplace_back(next->payload.begin(), next->payload.end());
  }
  expect_done("send " + quoted(drive) + to() + " --json sent.json");
  receive(expected.size());
  EXPECT_EQ(payloads_, expected);

  const auto report = json("sent.json");
  EXPECT_EQ(report["sent"], expected.size());
  EXPECT_EQ(report["failed"], 0);
  EXPECT_GE(report["wall_ms"], 1280) << "the drive takes 1.3 s and nothing is sent early";
  EXPECT_TRUE(report["late_ms"].contains("p99"));
}

TEST_F(CliSend, ReportsToThePacketWhatItsFaultsDid) {
  expect_done("send " + quoted(sparse_drive()) + to() +
              " --rate 2 --foreign-from 127.0.0.2 --json sent.json --faults "
              "'loss@0.1s:20packets duplicate@0.4s:7 foreign@0.6s:50 truncate@0.7s:5 "
              "reorder@0.8s:3 clock@0.9s:+2s burst@1s:50ms'");
  const auto report = json("sent.json");
  const std::uint64_t read = report["read"];
  EXPECT_EQ(report["sent"], read - 20 + 7 + 50);
  receive(report["sent"]);
  const std::vector<int> asked = {20, 7, 50, 5, 3};
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(report["faults"][i]["packets"], asked[i]) << report["faults"][i];
  }
  for (const auto& fault : report["faults"]) EXPECT_EQ(fault["complete"], true) << fault;
  EXPECT_EQ(source_->counters().kernel_drops, 0U);
  EXPECT_EQ(source_->counters().foreign, 50U);
  EXPECT_EQ(std::count_if(payloads_.begin(), payloads_.end(),
                          [](const auto& payload) { return payload.size() == 603; }),
            5);
}

TEST_F(CliSend, GoesThroughTheCaptureAsOftenAsItIsTold) {
  const Outcome outcome =
      run("send " + quoted(kDrive) + to() + " --rate 0 --loop 3 --json sent.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = json("sent.json");
  const std::uint64_t read = report["read"];
  EXPECT_EQ(read % 3, 0U);
  EXPECT_GT(read, 3U * 4000U);
  EXPECT_EQ(report["sent"], read);
  EXPECT_THAT(outcome.out, HasSubstr("sent "));
}

TEST_F(CliSend, EndsWithASummaryWhenInterrupted) {
  BackgroundProgram send(folder_, "send",
                         "send " + quoted(kDrive) + to() + " --loop --json sent.json");
  receive_one();
  send.interrupt();
  EXPECT_EQ(send.end().exit_code, 0);
  EXPECT_GT(json("sent.json")["sent"], 0);
}

TEST_F(CliSend, WarnsOfAFaultThatThePacketsEndBefore) {
  const Outcome outcome = run("send " + quoted(kDrive) + to() + " --rate 0 --faults pause@9s:1s");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning"), HasSubstr("pause@9s:1s")));
  EXPECT_THAT(outcome.out, HasSubstr("pause@9s:1s: 0 packets"));
}

TEST_F(CliSend, IsWhatASimulatedSensorDoes) {
  expect_done("simulate --scene flat --duration 0.3 --spin-hz 20 --udp 127.0.0.1:" +
              std::to_string(source_->local().port) +
              " --faults loss@0.1s:20packets --json sent.json");
  const auto report = json("sent.json");
  EXPECT_GT(report["sent"], 900);
  receive(report["sent"]);
  EXPECT_EQ(report["faults"][0]["packets"], 20);
  EXPECT_EQ(files_in(folder_, ".pcap"), 0U) << "no file was asked for";
}

TEST_F(CliSend, ASimulatedSensorTellsItsTableBeforeItsDriveIsComputed) {
  BackgroundProgram sensor(folder_, "sensor",
                           "simulate --scene flat --duration 3600 --spin-hz 20 --udp 127.0.0.1:" +
                               std::to_string(source_->local().port));
  sensor::Hdl64eSurvey told;
  constexpr std::size_t kSeconds = 10, kPacketsASecond = 3472;
  std::size_t heard = 0;
  while (!told.facts().table && heard < kSeconds * kPacketsASecond) {
    for (const auto& each : source_->receive(10'000'000)) {
      told.add(each.payload);
      ++heard;
    }
  }
  EXPECT_TRUE(told.facts().table) << heard << " packets";
  sensor.interrupt();
  EXPECT_EQ(sensor.end().exit_code, kInterrupted);
}

TEST_F(CliSend, ASimulatedSensorIsHeardBeforeItsDriveIsComputed) {
  BackgroundProgram sensor(folder_, "sensor",
                           "simulate --sensor vlp16 --scene flat --duration 3600 --udp 127.0.0.1:" +
                               std::to_string(source_->local().port));
  receive_one();
  sensor.interrupt();
  EXPECT_EQ(sensor.end().exit_code, kInterrupted) << "it was still computing";
}

TEST_F(CliSend, OfASimulatedSensorNeedsSomewhereToSendTo) {
  EXPECT_EQ(run("simulate --scene flat --duration 0.1").exit_code, 2);
  const Outcome outcome = run("simulate --scene flat --duration 0.1 -o a.pcap --faults loss@1s:1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--udp"));
}

TEST_F(CliSend, RefusesWhatItCannotDoAndSaysWhatIsExpected) {
  const auto expect_refusal = [&](const std::string& arguments, int exit_code,
                                  const std::string& message) {
    const Outcome outcome = run("send " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("error: "), HasSubstr(message))) << arguments;
  };
  const std::string drive = quoted(kDrive);
  expect_refusal(drive, 2, "--to is missing");
  expect_refusal(drive + " --to here:2368", 2, "'here' is no IPv4 address");
  expect_refusal(drive + " --to 127.0.0.1:", 2, "127.0.0.1:");
  expect_refusal(drive + " --to 127.0.0.1:0", 2, "127.0.0.1:0");
  expect_refusal(drive + to() + " --rate -1", 2, "--rate");
  expect_refusal(drive + to() + " --faults lose@2s:3", 2, "lose@2s:3");
  expect_refusal(drive + to() + " --interface nosuch0", 3, "nosuch0");
  expect_refusal(drive + to() + " --foreign-from 203.0.113.7", 3, "203.0.113.7");
  expect_refusal("none.pcap" + to(), 3, "no such file");
  expect_refusal(drive + to() + " --port 9", 5, "terracut info");
}

}  // namespace
}  // namespace terracut::cli
