// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut live` hears sensors that play captures. How fast is not tested: a machine may be busy.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "cli_fixture.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/live/live_pcap_source.hpp"
#include "firmware_io/live/packet_pacer.hpp"
#include "firmware_io/live/pass_stamps.hpp"
#include "firmware_io/live/udp_source.hpp"
#include "firmware_io/motion/vehicle_log.hpp"
#include "firmware_io/sinks/turn_stream_reader.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;

/// Sends a capture in real time from all of these addresses, over and over, until it is destroyed.
class Senders {
 public:
  /// Every datagram to `ports.at(its own port)`, or to the only port there is.
  Senders(std::vector<std::uint32_t> addresses, std::map<std::uint16_t, std::uint16_t> ports,
          fs::path capture = kDrive)
      : capture_(std::move(capture)) {
    for (const std::uint32_t address : addresses) {
      for (const auto& [recorded, port] : ports) {
        auto sender = firmware_io::UdpSender::open(
            {.to = {kLocalhost, port}, .from = firmware_io::Ipv4Endpoint{address, 0}}, memory_);
        if (!sender) throw std::runtime_error(sender.error().message);
        senders_.push_back({recorded, *std::move(sender)});
      }
    }
    thread_ = std::jthread([this] { play(); });
  }
  ~Senders() { pacer_.stop(); }

  static constexpr std::uint32_t kLocalhost = 0x7F000001;
  static constexpr std::uint16_t kAnyPort = 0;

 private:
  struct Sender {
    std::uint16_t recorded_port;
    firmware_io::UdpSender socket;
  };

  void play() {
    auto capture = firmware_io::PcapSource::open(capture_);
    if (!capture) throw std::runtime_error(capture.error().message);
    firmware_io::PassStamps stamps;
    while (!pacer_.stopped()) {
      const auto next = capture->next();
      if (!next) throw std::runtime_error(next.error().message);
      if (!*next) {
        if (!capture->rewind()) return;
        stamps.next_pass();
        continue;
      }
      firmware_io::Datagram datagram = **next;
      datagram.stamp_ns = stamps.place(datagram.stamp_ns);
      for (Sender& sender : senders_) {
        const bool is_its = sender.recorded_port == datagram.destination_port;
        if (is_its || sender.recorded_port == kAnyPort) pacer_.add(datagram, sender.socket);
      }
    }
  }

  fs::path capture_;
  rt::FixedMemory memory_;
  std::vector<Sender> senders_;
  firmware_io::PacketPacer pacer_{1, memory_};
  std::jthread thread_;
};

class CliLive : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    port_ = std::to_string(free_port());
  }
  /// A port that was free a moment ago.
  [[nodiscard]] static std::uint16_t free_port() {
    rt::FixedMemory memory;
    const auto source = firmware_io::UdpSource::open({}, memory);
    if (!source) throw std::runtime_error(source.error().message);
    return source->local().port;
  }
  [[nodiscard]] std::string live(const std::string& options) const {
    return "live --listen 127.0.0.1:" + port_ + " --metrics off --no-lock-memory --name test-" +
           port_ + " --deadline-ms 10000 " + options;
  }
  [[nodiscard]] std::uint16_t port_number() const {
    return static_cast<std::uint16_t>(std::stoi(port_));
  }
  /// A sensor at each of these addresses, as long as it lives.
  [[nodiscard]] Senders sensors_at(std::vector<std::uint32_t> addresses) const {
    return {std::move(addresses), {{Senders::kAnyPort, port_number()}}};
  }
  std::string port_;
};

TEST_F(CliLive, LabelsWhatIsSentToIt) {
  const Senders sensor = sensors_at({Senders::kLocalhost});
  const Outcome heard = run(live("--duration 3 --calibration " + quoted(kDriveCalibration) +
                                 " --labels labels --json live.json --trace trace.json"));
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
  const Outcome outcome = run(live("--patience 0.5 --calibration " + quoted(kDriveCalibration)));
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

TEST_F(CliLive, NamesTheSensorsWhenSeveralSendToThePort) {
  const Senders senders = sensors_at({Senders::kLocalhost, Senders::kLocalhost + 1});
  const Outcome outcome = run(live("--calibration " + quoted(kDriveCalibration)));
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_THAT(outcome.err, HasSubstr("127.0.0.1"));
  EXPECT_THAT(outcome.err, HasSubstr("127.0.0.2"));
  EXPECT_THAT(outcome.err, HasSubstr("--from"));
}

TEST_F(CliLive, LabelsOneOfSeveralSensorsAndCountsTheOthersPackets) {
  const Senders senders = sensors_at({Senders::kLocalhost, Senders::kLocalhost + 1});
  const Outcome outcome = run(live("--from 127.0.0.2 --duration 2 --json live.json --calibration " +
                                   quoted(kDriveCalibration)));
  EXPECT_THAT(outcome.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("at 127.0.0.2"));
  const auto summary = json("live.json");
  EXPECT_GT(summary.at("losses").at("foreign_datagrams").get<int>(), 100);
  EXPECT_EQ(summary.at("losses").at("rejected_repeated").get<int>(), 0);
}

TEST_F(CliLive, LeavesOutASensorThatIsSwitchedOnLater) {
  const Senders first = sensors_at({Senders::kLocalhost});
  const fs::path socket = folder_ / "turns";
  Outcome outcome;
  std::atomic<bool> ended = false;
  std::jthread listener([&] {
    outcome = run(live("--duration 3 --json live.json --stream " + quoted(socket) +
                       " --calibration " + quoted(kDriveCalibration)));
    ended = true;
  });
  // It is there once the program knows its sensor.
  while (!fs::exists(socket) && !ended) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Senders later = sensors_at({Senders::kLocalhost + 1});
  listener.join();
  EXPECT_THAT(outcome.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << outcome.err;
  const auto summary = json("live.json");
  EXPECT_GT(summary.at("losses").at("foreign_datagrams").get<int>(), 0);
  EXPECT_EQ(summary.at("losses").at("rejected_repeated").get<int>(), 0);
}

TEST_F(CliLive, TakesTheAnglesOfARuby128FromItsOtherPort) {
  expect_done("simulate --sensor ruby128 --scene flat --duration 1.1 -o ruby.pcap");
  const std::uint16_t device_port = free_port();
  const Senders sensor({Senders::kLocalhost}, {{6699, port_number()}, {7788, device_port}},
                       folder_ / "ruby.pcap");
  const Outcome heard = run(live("--sensor ruby128 --device-port " + std::to_string(device_port) +
                                 " --duration 4 --json live.json"));
  EXPECT_THAT(heard.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << heard.err;
  EXPECT_THAT(heard.err, HasSubstr("RS-Ruby128 at 127.0.0.1"));
  EXPECT_GT(json("live.json").at("frames").at("count").get<int>(), 5);
}

TEST_F(CliLive, HearsByLibpcapWhatAnotherProgramHasThePortOf) {
  rt::FixedMemory memory;
  if (const auto allowed = firmware_io::LivePcapSource::open({.interface = "lo"}, memory);
      !allowed) {
    GTEST_SKIP() << allowed.error().message;
  }
  const auto taken = firmware_io::UdpSource::open({.bind = {0, port_number()}}, memory);
  ASSERT_TRUE(taken) << taken.error().message;
  const Senders senders = sensors_at({Senders::kLocalhost});
  const Outcome outcome =
      run(live("--via libpcap --interface lo --duration 2 --json live.json "
               "--calibration " +
               quoted(kDriveCalibration)));
  EXPECT_THAT(outcome.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << outcome.err;
  EXPECT_GT(json("live.json").at("frames").at("count").get<int>(), 5);
}

TEST_F(CliLive, GivesLabelledPointsToOtherProcesses) {
  const Senders senders = sensors_at({Senders::kLocalhost});
  const fs::path socket = folder_ / "turns";
  Outcome outcome;
  std::atomic<bool> ended = false;
  std::jthread listener([&] {
    outcome = run(live("--duration 4 --labels labels --stream " + quoted(socket) +
                       " --calibration " + quoted(kDriveCalibration)));
    ended = true;
  });
  while (!fs::exists(socket) && !ended) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto address = firmware_io::parse_stream_address(socket.string());
  ASSERT_TRUE(address) << address.error().message;
  auto reader = firmware_io::TurnStreamReader::connect(*address);
  ASSERT_TRUE(reader) << reader.error().message;
  std::vector<firmware_io::ReceivedTurn> turns(3);
  constexpr std::int64_t kPatience_ns = 10'000'000'000;
  for (firmware_io::ReceivedTurn& turn : turns) {
    const auto read = reader->next(turn, kPatience_ns);
    EXPECT_TRUE(read) << read.error().message;
  }
  listener.join();
  // The points are the label files' returns, in their order.
  for (const firmware_io::ReceivedTurn& turn : turns) {
    const auto ids = ids_of(folder_ / "labels" / fmt::format("{:06}.label", turn.header.number));
    ASSERT_EQ(turn.points.size(), ids.size()) << turn.header.number;
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(turn.points[i].label, ids[i]);
    EXPECT_EQ(turn.header.sensor, 1);
  }
}

TEST_F(CliLive, GoesOnWithoutTheVehiclesMotionWhereItsInterfacesAreNotThere) {
  const Senders senders = sensors_at({Senders::kLocalhost});
  write("car.dbc", firmware_io::vehicle_dbc());
  const Outcome outcome = run(live("--duration 3 --json live.json --labels labels --calibration " +
                                   quoted(kDriveCalibration) +
                                   " --can nosuchcan0 --dbc car.dbc --health-can nosuchcan1"));
  EXPECT_THAT(outcome.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed))) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no such interface 'nosuchcan0'"));
  EXPECT_THAT(outcome.err, HasSubstr("no such interface 'nosuchcan1'"));
  EXPECT_THAT(outcome.out, HasSubstr("motion    interface_gone on nosuchcan0"));
  const auto summary = json("live.json");
  const auto frames = summary.at("frames").at("count").get<int>();
  EXPECT_GT(frames, 5);
  EXPECT_EQ(summary.at("motion").at("no_ego_motion_frames"), frames);
  EXPECT_EQ(summary.at("motion").at("taken_out_frames"), 0);
  EXPECT_GT(summary.at("health").at("link_down").get<int>(), 0);
}

TEST_F(CliLive, RefusesAVehicleWhoseFramesItCannotRead) {
  EXPECT_THAT(run(live("--can can0")).err, HasSubstr("no DBC file is given"));
  EXPECT_THAT(run(live("--dbc car.dbc")).err, HasSubstr("--dbc requires --can"));
  EXPECT_THAT(run(live("--can can0 --dbc none.dbc")).err, HasSubstr("none.dbc"));
  write("other.dbc", "BO_ 291 OTHER: 8 ECU\n SG_ OTHER : 0|8@1+ (1,0) [0|0] \"\" ECU\n");
  const Outcome signal = run(live("--can can0 --dbc other.dbc"));
  EXPECT_EQ(signal.exit_code, kUsage);
  EXPECT_THAT(signal.err, HasSubstr("SPEED"));
  write("terracut.yaml", "motion:\n  can: can0\n");
  const Outcome of_file = run(live("--config terracut.yaml --dbc none.dbc"));
  EXPECT_THAT(of_file.err, HasSubstr("none.dbc")) << "the file names the interface";
}

TEST_F(CliLive, RefusesAnInterfaceOfAnotherKind) {
  const Senders senders = sensors_at({Senders::kLocalhost});
  write("car.dbc", firmware_io::vehicle_dbc());
  const Outcome outcome =
      run(live("--can lo --dbc car.dbc --calibration " + quoted(kDriveCalibration)));
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, AnyOf(HasSubstr("no CAN sockets"), HasSubstr("no CAN interface")));
}

TEST_F(CliLive, SaysWhichOptionLibpcapNeeds) {
  const Outcome outcome = run(live("--via libpcap"));
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_THAT(outcome.err, HasSubstr("--interface"));
}

TEST_F(CliLive, SaysHowLongItWaitedForASensor) {
  const Outcome outcome = run(live("--patience 0.2"));
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("within 0.2 s"));
}

}  // namespace
}  // namespace terracut::cli
