// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut live` hears sensors that play captures. How fast is not tested: a machine may be busy.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <vector>

#include "firmware_io/net/live_pcap_source.hpp"
#include "firmware_io/net/udp_source.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "tests/support/frame_stream_reader.hpp"
#include "tests/support/rewritten_capture.hpp"
#include "tests/tools/cli/live/cli_live.hpp"
#include "tools/lab/drive/vehicle_log.hpp"

namespace terracut::cli {
namespace {

using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;

/// A Ruby128's capture with what it says of itself, which comes once a second, before every 100th
/// packet: a run waits seconds for it, in which a busy machine hears little of the stream.
void tell_angles_often(const fs::path& from, const fs::path& to) {
  std::vector<std::uint8_t> told;
  std::uint16_t device_port = 0;
  test::rewrite_capture(from, to, [&](auto datagram, auto n, auto& write) {
    if (n == 0) {
      told.assign(datagram.payload.begin(), datagram.payload.end());
      device_port = datagram.destination_port;
    }
    write(datagram);
    datagram.payload = told;
    datagram.destination_port = device_port;
    if (n % 100 == 0) write(datagram);
  });
  ASSERT_EQ(device_port, 7788) << "the capture begins with what the sensor says of itself";
}

TEST_F(CliLive, FindsTheMountBeforeItLabels) {
  LiveRun run = live_with_table("--json live.json");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 1));
  const Outcome outcome = run.interrupted();
  EXPECT_THAT(outcome.err, HasSubstr("mount: height 1.7"));
  const auto mount = json("live.json")["mount"];
  EXPECT_NEAR(mount["height_m"], 1.73, 0.04);
  EXPECT_GE(mount["found_in_frames"], 10);
  EXPECT_LT(mount["uncertainty"]["pitch_deg"], 1);
}

TEST_F(CliLive, CountsWhatCameBeforeLabellingBegan) {
  LiveRun run = live_with_table("--json live.json");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(run.shows([](const auto& figures) {
    return figures.before_labelling > 0 && figures.received == 0 &&
           figures.link == status::LinkState::kReceiving && figures.deadline_ns > 0;
  })) << "while it finds the mount";
  EXPECT_TRUE(labels(run, 1));
  const Outcome outcome = run.interrupted();
  EXPECT_THAT(outcome.out, HasSubstr("datagrams before labelling began"));
  EXPECT_GT(json("live.json")["datagrams"]["before_labelling"], 1000) << "a second of packets";
}

TEST_F(CliLive, GoesOnWithAGuessThatItShowsWhereNoGroundIsSeen) {
  // Of every revolution a fifth, and so no ground behind the vehicle nor straight ahead.
  std::int64_t begin_ns = 0;
  test::rewrite_capture(kDrive, folder_ / "aside.pcap",
                        [&](const auto& datagram, auto n, auto& write) {
                          if (n == 0) begin_ns = datagram.stamp_ns;
                          const std::int64_t into_ns = (datagram.stamp_ns - begin_ns) % 100'000'000;
                          if (into_ns >= 20'000'000 && into_ns <= 40'000'000) write(datagram);
                        });
  LiveRun run = live_with_table("--mount-guess --json live.json");
  const Sensors sender({Sensors::kLocalhost}, {{Sensors::kAnyPort, run.port()}},
                       folder_ / "aside.pcap");
  EXPECT_TRUE(run.shows([](const auto& figures) { return figures.mount.guessed != 0; }));
  const Outcome outcome = run.interrupted();
  EXPECT_THAT(outcome.err, HasSubstr("warning: the mount is not found: of "));
  EXPECT_THAT(outcome.out, HasSubstr("not found and not stated: a guess, height 1.73 m"));
  EXPECT_EQ(json("live.json")["mount"]["guessed"], true);
}

TEST_F(CliLive, LabelsWhatIsSentToIt) {
  LiveRun run = live_with_table("--labels labels --json live.json --trace trace.json");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 6));
  const Outcome heard = run.interrupted();
  expect_good_end(heard);
  EXPECT_THAT(heard.err, HasSubstr("HDL-64E"));
  const auto summary = json("live.json");
  const auto frames = summary.at("frames").at("count").get<std::size_t>();
  const auto skipped = summary.at("frames").at("levels").at("skipped").get<std::size_t>();
  EXPECT_GE(frames - skipped, 6U);
  const auto unwritten = summary.at("losses").at("unwritten_label_frames").get<std::size_t>();
  EXPECT_EQ(files_in(folder_ / "labels", ".label") + unwritten, frames - skipped);
  for (const auto& entry : fs::directory_iterator(folder_ / "labels")) {
    EXPECT_GT(entry.file_size(), 0U);
  }
  EXPECT_TRUE(json("trace.json").contains("traceEvents"));
}

TEST_F(CliLive, SaysWhatTakesTheSensorsViewAway) {
  std::vector<std::uint8_t> packet;
  test::rewrite_capture(kDrive, folder_ / "covered.pcap", [&](auto datagram, auto, auto& write) {
    packet.assign(datagram.payload.begin(), datagram.payload.end());
    constexpr std::size_t kPacketBytes = 1206, kBlockBytes = 100, kBlocks = 12;
    for (std::size_t at = 0; packet.size() == kPacketBytes && at < kBlocks * kBlockBytes;
         at += kBlockBytes) {
      const int head_cdeg = packet[at + 2] | packet[at + 3] << 8;
      if (head_cdeg < 12'000 || head_cdeg > 18'000) continue;
      std::fill_n(packet.begin() + static_cast<std::ptrdiff_t>(at) + 4, kBlockBytes - 4, 0);
    }
    datagram.payload = packet;
    write(datagram);
  });
  LiveRun run = live_with_table("--sight --json live.json");
  {
    const Sensors clear = sensor(run);
    EXPECT_TRUE(run.shows([](const auto& figures) { return figures.sight.has_learnt != 0; }));
  }
  const Sensors covered({Sensors::kLocalhost}, {{Sensors::kAnyPort, run.port()}},
                        folder_ / "covered.pcap");
  EXPECT_TRUE(run.says("warning: the sensor's view is blocked, covered: "));
  EXPECT_TRUE(run.shows([](const auto& figures) {
    return figures.sight.in(visibility::Direction::kBehindRight).troubled > 0;
  }));
  const Outcome outcome = run.interrupted();
  EXPECT_THAT(outcome.out, HasSubstr("sight     blocked, covered: "));
  const auto sight = json("live.json").at("sight");
  EXPECT_EQ(sight.at("state"), "blocked");
  EXPECT_EQ(sight.at("directions").at("left").at("troubled_sectors"), 0);
}

TEST_F(CliLive, EndsByItselfAfterTheTimeItIsGiven) {
  LiveRun run = live_with_table("--duration 0.5 --json live.json");
  const Sensors sender = sensor(run);
  const Outcome outcome = run.end();
  EXPECT_THAT(outcome.exit_code, AnyOf(Eq(kOk), Eq(kDeadlinesMissed), Eq(kNothingCameOut)))
      << outcome.err;
  const auto summary = json("live.json");
  EXPECT_GE(
      summary.at("taken_ns").get<std::int64_t>() - summary.at("started_ns").get<std::int64_t>(),
      500'000'000);
}

TEST_F(CliLive, SaysThatItWasInterruptedBeforeItsTimeWasOver) {
  LiveRun run = live_with_table("--duration 100000 --json live.json");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 1));
  const Outcome outcome = run.interrupted();
  EXPECT_EQ(outcome.exit_code, kInterrupted) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ended     interrupted"));
  EXPECT_TRUE(json("live.json").at("interrupted").get<bool>());
}

TEST_F(CliLive, SaysWhatItHeardInsteadOfASensor) {
  const Outcome outcome = live_with_table("--patience 0.5").end();
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("no data packets"));
}

TEST_F(CliLive, WaitsForItsSensorWhichOthersCanSee) {
  LiveRun run = live_with_table("--json live.json");
  EXPECT_TRUE(run.shows([](const auto& figures) {
    return figures.link == status::LinkState::kWaiting &&
           figures.sensor.view().find("waiting for") != std::string_view::npos;
  }));
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 1));
  expect_good_end(run.interrupted());
  const auto datagrams = json("live.json").at("datagrams");
  std::uint64_t sum = 0;
  for (const auto& count : datagrams.at("outcomes")) sum += count.template get<std::uint64_t>();
  EXPECT_EQ(sum, datagrams.at("received").get<std::uint64_t>());
}

TEST_F(CliLive, EndsInOrderWhileItWaits) {
  LiveRun run = live_with_table("");
  (void)run.port();
  EXPECT_EQ(run.interrupted().exit_code, kOk);
}

TEST_F(CliLive, NamesAPortThatIsTaken) {
  memory::FixedMemory memory;
  const auto taken = net::UdpSource::open({}, memory);
  ASSERT_TRUE(taken);
  const Outcome outcome = live("--listen 0.0.0.0:" + std::to_string(taken->local().port)).end();
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("port"));
}

TEST_F(CliLive, NamesTheSensorsWhenSeveralSendToThePort) {
  LiveRun run = live_with_table("");
  const Sensors senders = sensors_at({Sensors::kLocalhost, Sensors::kLocalhost + 1}, run);
  const Outcome outcome = run.end();
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_THAT(outcome.err, HasSubstr("127.0.0.1"));
  EXPECT_THAT(outcome.err, HasSubstr("127.0.0.2"));
  EXPECT_THAT(outcome.err, HasSubstr("--from"));
}

TEST_F(CliLive, StartsAgainWithItsSensorThoughAnotherOneSendsByNow) {
  {
    LiveRun before = live_with_table("");
    const Sensors sender = sensor(before);
    EXPECT_TRUE(labels(before, 1));
    before.interrupt(SIGKILL);
  }
  LiveRun run = live_with_table("");
  const Sensors senders = sensors_at({Sensors::kLocalhost + 1, Sensors::kLocalhost}, run);
  EXPECT_TRUE(run.says("127.0.0.1, which was in use before, is heard and not "));
  EXPECT_TRUE(labels(run, 3));
  EXPECT_TRUE(run.shows(
      [](const auto& figures) { return LiveRun::loss(figures, "foreign_datagrams") > 0; }));
  expect_good_end(run.interrupted());
}

TEST_F(CliLive, LabelsOneOfSeveralSensorsAndCountsTheOthersPackets) {
  LiveRun run = live_with_table("--from 127.0.0.2 --json live.json");
  const Sensors senders = sensors_at({Sensors::kLocalhost, Sensors::kLocalhost + 1}, run);
  EXPECT_TRUE(run.shows([](const auto& figures) {
    return LiveRun::labelled(figures) > 0 && LiveRun::loss(figures, "foreign_datagrams") > 100;
  }));
  const Outcome outcome = run.interrupted();
  expect_good_end(outcome);
  EXPECT_THAT(outcome.err, HasSubstr("at 127.0.0.2"));
  EXPECT_EQ(json("live.json").at("losses").at("rejected_repeated").get<int>(), 0);
}

TEST_F(CliLive, LeavesOutASensorThatIsSwitchedOnLater) {
  LiveRun run = live_with_table("--json live.json");
  const Sensors first = sensor(run);
  EXPECT_TRUE(labels(run, 1));
  const Sensors later = sensors_at({Sensors::kLocalhost + 1}, run);
  EXPECT_TRUE(run.shows(
      [](const auto& figures) { return LiveRun::loss(figures, "foreign_datagrams") > 0; }));
  expect_good_end(run.interrupted());
  EXPECT_EQ(json("live.json").at("losses").at("rejected_repeated").get<int>(), 0);
}

TEST_F(CliLive, TakesTheAnglesOfARuby128FromItsOtherPort) {
  expect_done("simulate --sensor ruby128 --scene flat --duration 0.5 -o ruby.pcap");
  tell_angles_often(folder_ / "ruby.pcap", folder_ / "often.pcap");
  // Held by this test, so that nobody else gets it, and shared with the run.
  memory::FixedMemory memory;
  const auto device = net::UdpSource::open({.share_port = true}, memory);
  ASSERT_TRUE(device) << device.error().message;
  const std::uint16_t device_port = device->local().port;
  LiveRun run =
      live("--sensor ruby128 --device-port " + std::to_string(device_port) + " --json live.json");
  const Sensors sender({Sensors::kLocalhost}, {{6699, run.port()}, {7788, device_port}},
                       folder_ / "often.pcap");
  EXPECT_TRUE(labels(run, 3));
  const Outcome heard = run.interrupted();
  expect_good_end(heard);
  EXPECT_THAT(heard.err, HasSubstr("RS-Ruby128 at 127.0.0.1"));
}

TEST_F(CliLive, HearsByLibpcapWhatAnotherProgramHasThePortOf) {
  memory::FixedMemory memory;
  if (const auto allowed = net::LivePcapSource::open({.interface = "lo"}, memory); !allowed) {
    GTEST_SKIP() << allowed.error().message;
  }
  const auto taken = net::UdpSource::open({}, memory);
  ASSERT_TRUE(taken) << taken.error().message;
  const std::uint16_t port = taken->local().port;
  LiveRun run =
      live_with_table("--via libpcap --interface lo --listen 127.0.0.1:" + std::to_string(port));
  EXPECT_TRUE(run.says("listening at"));
  const Sensors sender({Sensors::kLocalhost}, {{Sensors::kAnyPort, port}}, kDrive);
  EXPECT_TRUE(labels(run, 3));
  expect_good_end(run.interrupted());
}

TEST_F(CliLive, GivesLabelledPointsToOtherProcesses) {
  const fs::path socket = folder_ / "frames";
  LiveRun run = live_with_table("--labels labels --json live.json --stream " + quoted(socket));
  const Sensors sender = sensor(run);
  ASSERT_TRUE(run.says("labelled points at "));
  const auto address = stream::parse_stream_address(socket.string());
  ASSERT_TRUE(address) << address.error().message;
  auto reader = test::FrameStreamReader::connect(*address);
  ASSERT_TRUE(reader) << reader.error().message;
  constexpr int kHour_ms = 3'600'000;
  std::vector<test::ReceivedFrame> frames(3);
  for (test::ReceivedFrame& frame : frames) {
    const auto read = reader->next(frame, kHour_ms);
    EXPECT_TRUE(read) << read.error().message;
  }
  expect_good_end(run.interrupted());
  // The points are the label files' returns, in their order.
  std::uint64_t missing = 0;
  for (const test::ReceivedFrame& frame : frames) {
    EXPECT_EQ(frame.header.sensor, 1);
    const fs::path file = folder_ / "labels" / fmt::format("{:06}.label", frame.header.number);
    if (!fs::exists(file)) {
      ++missing;
      continue;
    }
    const auto ids = ids_of(file);
    ASSERT_EQ(frame.points.size(), ids.size()) << frame.header.number;
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(frame.points[i].label, ids[i]);
  }
  EXPECT_LE(missing, json("live.json").at("losses").at("unwritten_label_frames"));
  EXPECT_LT(missing, frames.size());
}

TEST_F(CliLive, GivesSectorsToThoseWhoAskForThem) {
  const fs::path socket = folder_ / "frames";
  LiveRun run = live_with_table("--labels labels --json live.json --stream-sectors --stream " +
                                quoted(socket));
  const Sensors sender = sensor(run);
  ASSERT_TRUE(run.says("labelled points at "));
  auto reader = test::FrameStreamReader::connect(*stream::parse_stream_address(socket.string()));
  ASSERT_TRUE(reader) << reader.error().message;
  reader->ask_for_sectors();
  // A busy machine's reader misses some; one frame of which it has all says what is to be said.
  constexpr int kHour_ms = 3'600'000;
  std::vector<std::uint32_t> labels;
  test::ReceivedFrame got;
  const auto is_whole = [&] {
    return (got.header.flags & stream::kFrameSector) == 0 && got.points.empty() &&
           got.header.first_return == labels.size() && !labels.empty() &&
           fs::exists(folder_ / "labels" / fmt::format("{:06}.label", got.header.number));
  };
  while (!is_whole()) {
    const auto read = reader->next(got, kHour_ms);
    ASSERT_TRUE(read && *read) << (read ? "the end" : read.error().message);
    if (got.header.first_return == 0) labels.clear();
    if ((got.header.flags & stream::kFrameSector) == 0) continue;
    if (got.header.first_return != labels.size()) labels.clear();
    for (const stream::WirePoint& point : got.points) labels.push_back(point.label);
  }
  expect_good_end(run.interrupted());
  EXPECT_EQ(labels, ids_of(folder_ / "labels" / fmt::format("{:06}.label", got.header.number)));
  EXPECT_TRUE(json("live.json").at("losses").contains("stream_sectors_missed"));
}

TEST_F(CliLive, SaysWhereItsFiguresAre) {
  LiveRun run = live_with_table("--metrics 127.0.0.1:0");
  const Sensors sender = sensor(run);
  const std::string at = run.said_after("figures at http://");
  const auto served =
      test::FrameStreamReader::connect(*stream::parse_stream_address(at.substr(0, at.find('/'))));
  EXPECT_TRUE(served) << served.error().message;
  EXPECT_THAT(at, testing::EndsWith("/metrics"));
  const std::string port = at.substr(at.find(':') + 1, at.find('/') - at.find(':') - 1);
  LiveRun other = live_with_table("--metrics 127.0.0.1:" + port);
  EXPECT_TRUE(other.says(
      "no /metrics, which is tried again every 10 s: cannot serve /metrics on 127.0.0.1:" + port))
      << "though it has not heard its sensor";
  (void)other.interrupted();
  (void)run.interrupted();
}

TEST_F(CliLive, WritesDumpsThatCanBeReplayedAsIsPrinted) {
  LiveRun recorded = live_with_table("--recorder-folder dumps");
  const Sensors sender = sensor(recorded);
  const Outcome dumped = dump_of(recorded);
  (void)recorded.interrupted();
  ASSERT_EQ(dumped.exit_code, 0) << dumped.err;
  const std::string way = "replay it: terracut ";
  const auto begin = dumped.err.find(way);
  ASSERT_NE(begin, std::string::npos) << dumped.err;
  const auto first = begin + way.size();
  const std::string command = dumped.err.substr(first, dumped.err.find('\n', first) - first);
  expect_done(command + " --json replayed.json");
  EXPECT_GE(json("replayed.json")["summary"]["frames"], 1);
}

TEST_F(CliLive, AnswersAtOnceThatItKeepsNoPackets) {
  LiveRun unrecorded = live_with_table("");
  const Sensors sender = sensor(unrecorded);
  const Outcome dumped = dump_of(unrecorded);
  (void)unrecorded.interrupted();
  EXPECT_EQ(dumped.exit_code, kOutputFailed);
  EXPECT_THAT(dumped.err, HasSubstr("no_recorder"));
  EXPECT_THAT(dumped.err, HasSubstr("--recorder-folder"));
}

TEST_F(CliLive, AnswersAtOnceThatThereIsNothingToDumpBeforeItHasHeardItsSensor) {
  LiveRun waiting = live_with_table("--recorder-folder dumps");
  EXPECT_TRUE(waiting.shows([](const auto&) { return true; }));
  for (int asked = 0; asked < 2; ++asked) {
    const Outcome refused = run("dump " + LiveRun::name() + " --wait 60");
    EXPECT_EQ(refused.exit_code, kOutputFailed);
    EXPECT_THAT(refused.err, HasSubstr("refused (nothing_held): labelling has not begun"));
  }
  const Sensors sender = sensor(waiting);
  EXPECT_EQ(dump_of(waiting).exit_code, kOk);
  (void)waiting.interrupted();
}

TEST_F(CliLive, WarnsOfATableThatIsNotTheOneInThePackets) {
  std::string table = content_of(kDriveCalibration);
  const std::string key = "<vertOffsetCorrection_>";
  const auto value = table.find(key);
  ASSERT_NE(value, std::string::npos);
  const auto digits = value + key.size();
  table.replace(digits, table.find('<', digits) - digits, "23.4");
  write("other.xml", table);
  LiveRun other = live("--calibration other.xml");
  const Sensors sender = sensor(other);
  EXPECT_THAT(other.said_after("the packets carry "), HasSubstr("another calibration"));
  expect_good_end(other.interrupted());
}

TEST_F(CliLive, GoesOnWithoutTheVehiclesMotionWhereItsInterfacesAreNotThere) {
  write("car.dbc", drive::vehicle_dbc());
  LiveRun run =
      live_with_table("--json live.json --can nosuchcan0 --dbc car.dbc --health-can nosuchcan1");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 3));
  const Outcome outcome = run.interrupted();
  expect_good_end(outcome);
  EXPECT_THAT(outcome.err, HasSubstr("no such interface 'nosuchcan0'"));
  EXPECT_THAT(outcome.err, HasSubstr("no such interface 'nosuchcan1'"));
  EXPECT_THAT(outcome.out, HasSubstr("motion    interface_gone on nosuchcan0"));
  const auto summary = json("live.json");
  EXPECT_EQ(summary.at("motion").at("no_ego_motion_frames"), summary.at("frames").at("count"));
  EXPECT_EQ(summary.at("motion").at("deskewed_frames"), 0);
  EXPECT_GT(summary.at("health").at("link_down").get<int>(), 0);
}

TEST_F(CliLive, RefusesAVehicleWhoseFramesItCannotRead) {
  const auto refusal = [&](const std::string& options) { return live(options).end(); };
  EXPECT_THAT(refusal("--can can0").err, HasSubstr("no DBC file is given"));
  EXPECT_THAT(refusal("--dbc car.dbc").err, HasSubstr("--dbc needs --can"));
  EXPECT_THAT(refusal("--can can0 --dbc none.dbc").err, HasSubstr("none.dbc"));
  write("other.dbc", "BO_ 291 OTHER: 8 ECU\n SG_ OTHER : 0|8@1+ (1,0) [0|0] \"\" ECU\n");
  const Outcome signal = refusal("--can can0 --dbc other.dbc");
  EXPECT_EQ(signal.exit_code, kUsage);
  EXPECT_THAT(signal.err, HasSubstr("SPEED"));
  write("terracut.yaml", "motion:\n  can: can0\n");
  const Outcome of_file = refusal("--config terracut.yaml --dbc none.dbc");
  EXPECT_THAT(of_file.err, HasSubstr("none.dbc")) << "the file names the interface";
}

TEST_F(CliLive, RefusesAnInterfaceOfAnotherKind) {
  write("car.dbc", drive::vehicle_dbc());
  LiveRun run = live_with_table("--can lo --dbc car.dbc");
  const Sensors sender = sensor(run);
  const Outcome outcome = run.end();
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, AnyOf(HasSubstr("no CAN sockets"), HasSubstr("no CAN interface")));
}

TEST_F(CliLive, SaysWhichOptionLibpcapNeeds) {
  const Outcome outcome = live("--via libpcap").end();
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_THAT(outcome.err, HasSubstr("--interface"));
}

TEST_F(CliLive, SaysHowLongItWaitedForASensor) {
  const Outcome outcome = live("--patience 0.2").end();
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("within 0.2 s"));
}

}  // namespace
}  // namespace terracut::cli
