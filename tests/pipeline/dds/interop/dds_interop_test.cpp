// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Clouds that terracut publishes, before readers that others wrote: Fast DDS, Cyclone DDS with its
// own idea of the type, Wireshark's dissector. On loopback; a frame is sent when the one before has
// been read, and not before its tenth of a second.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cloud_pattern.hpp"
#include "pipeline/dds/cloud_reader.hpp"
#include "pipeline/dds/dds_sink.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/cli/background_program.hpp"

namespace terracut::interop {
namespace {

using cli::BackgroundProgram;

class DdsInterop : public test::InScratchFolder {
 protected:
  /// Of everything here: loopback, and a buffer for large clouds; and what else is said.
  static void configure(const std::string& more = "") {
    const std::string configuration =
        "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/>"
        "</Interfaces></General><Internal><SocketReceiveBufferSize max=\"8MB\"/></Internal>" +
        more + "</Domain></CycloneDDS>";
    ::setenv("CYCLONEDDS_URI", configuration.c_str(), 1);
  }
  static void SetUpTestSuite() { configure(); }
  [[nodiscard]] std::unique_ptr<dds::DdsSink> open_sink() const {
    auto sink = dds::DdsSink::open(
        {.participant = {.domain = domain_, .interface = {}}, .points = kTopic}, {});
    EXPECT_TRUE(sink) << sink.error().message;
    return sink ? *std::move(sink) : nullptr;
  }
  [[nodiscard]] std::string reader_arguments() const {
    return std::to_string(domain_) + " " + kTopic;
  }

  /// Returns how many frames the reader had, whole and right.
  static std::uint32_t send(std::uint32_t frames, dds::DdsSink& sink, BackgroundProgram& reader) {
    EXPECT_TRUE(reader.says("matched 1\n"));
    while (sink.readers() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    publish::LabelledFrame frame;
    auto next = std::chrono::steady_clock::now();
    for (std::uint32_t number = 0; number < frames; ++number) {
      frame.record.info.first_packet_ns = std::int64_t{number} * 1'000'000'000;
      frame.points.clear();
      for (std::uint32_t i = 0; i < kPoints; ++i) {
        const PatternPoint point = pattern_point(number, i);
        frame.points.push_back({point.x_m, point.y_m, point.z_m, point.intensity,
                                point.label == 99 ? frame::Label::kObstacle : frame::Label::kGround,
                                point.ring, point.time_s});
      }
      std::this_thread::sleep_until(next);
      next = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
      EXPECT_TRUE(sink.put(frame));
      if (!reader.says("\nframe " + std::to_string(number) + "\n")) return number;
    }
    return frames;
  }

  static constexpr const char* kTopic = "rt/terracut_interop/points";
  const int domain_ = 1 + static_cast<int>(::getpid() % 200);
};

TEST_F(DdsInterop, FastDdsReadsEveryFrameReliably) {
#ifndef TERRACUT_FAST_READER
  GTEST_SKIP() << "no Fast DDS (libfastrtps-dev, fastddsgen)";
#else
  const auto sink = open_sink();
  ASSERT_TRUE(sink);
  BackgroundProgram reader(folder_, "fast", reader_arguments(), TERRACUT_FAST_READER);
  EXPECT_EQ(send(kFrames, *sink, reader), kFrames);
  EXPECT_EQ(reader.end().exit_code, 0);
#endif
}

TEST_F(DdsInterop, APlainCycloneReaderWithSensorDataQosReadsEveryFrame) {
  const auto sink = open_sink();
  ASSERT_TRUE(sink);
  BackgroundProgram reader(folder_, "plain", reader_arguments(), TERRACUT_PLAIN_READER);
  EXPECT_EQ(send(kFrames, *sink, reader), kFrames);
  EXPECT_EQ(reader.end().exit_code, 0);
}

TEST_F(DdsInterop, SectorsOfALiveRunPutTogetherAreItsTurns) {
  const auto participant = dds::Participant::open({.domain = domain_, .interface = {}});
  ASSERT_TRUE(participant) << participant.error().message;
  auto turns = dds::CloudReader::open(*participant, "rt/terracut/points", false);
  auto sectors = dds::CloudReader::open(*participant, "rt/terracut/sectors", false);
  ASSERT_TRUE(turns && sectors);
  const int port = 24'000 + static_cast<int>(::getpid() % 2000);
  BackgroundProgram simulated(folder_, "simulate",
                              "simulate --scene flat --duration 1 -o drive.pcap");
  ASSERT_EQ(simulated.end().exit_code, 0);
  BackgroundProgram live(
      folder_, "live",
      "live --calibration drive.calibration.xml --mount-height 1.73 "
      "--mount-roll 0 --mount-pitch 0 --priority 0 --duration 120 --dds --sectors "
      "--dds-interface lo --listen 127.0.0.1:" +
          std::to_string(port) + " --dds-domain " + std::to_string(domain_));
  BackgroundProgram sender(folder_, "send",
                           "send drive.pcap --loop 100 --to 127.0.0.1:" + std::to_string(port));

  struct Came {
    std::int64_t stamp_ns;
    std::uint32_t points;
  };
  std::vector<Came> of_turns, of_sectors;
  const auto take_all = [](dds::CloudReader& reader, std::vector<Came>& came) {
    while (const dds::TakenCloud cloud = reader.take()) {
      const auto& stamp = cloud->header.stamp;
      came.push_back({std::int64_t{stamp.sec} * 1'000'000'000 + stamp.nanosec, cloud->width});
    }
  };
  // A turn's first sector begins beside its first packet, as does the last one of the turn before.
  const auto is_whole = [&](const Came& turn) {
    for (auto first = of_sectors.begin(); first != of_sectors.end(); ++first) {
      if (std::abs(first->stamp_ns - turn.stamp_ns) > 5'000'000) continue;
      std::uint32_t points = 0;
      for (auto at = first; at != of_sectors.end() && points < turn.points; ++at) {
        points += at->points;
      }
      if (points == turn.points) return true;
    }
    return false;
  };
  // A reader that is late misses some; one turn of which it has all says what is to be said.
  bool one_is_whole = false;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!one_is_whole && std::chrono::steady_clock::now() < end) {
    sectors->wait(5'000'000);
    take_all(*sectors, of_sectors);
    const std::size_t before = of_turns.size();
    take_all(*turns, of_turns);
    for (std::size_t i = before; i < of_turns.size() && !one_is_whole; ++i) {
      one_is_whole = is_whole(of_turns[i]);
    }
  }
  live.interrupt();
  sender.interrupt();
  const cli::Outcome ended = live.end();
  (void)sender.end();
  EXPECT_TRUE(one_is_whole) << of_turns.size() << " turns, " << of_sectors.size() << " sectors\n"
                            << ended.out << ended.err;
}

TEST_F(DdsInterop, WiresharksDissectorShowsTopicAndType) {
  if (std::system("command -v tshark >/dev/null") != 0) GTEST_SKIP() << "no tshark";
  // Cyclone itself keeps what it sends, so that nobody needs a right to capture.
  const cli::fs::path capture = folder_ / "dds.pcap";
  configure("<Tracing><PacketCaptureFile>" + capture.string() + "</PacketCaptureFile></Tracing>");
  auto sink = open_sink();
  configure();
  ASSERT_TRUE(sink);
  {
    BackgroundProgram reader(folder_, "plain", reader_arguments(), TERRACUT_PLAIN_READER);
    EXPECT_EQ(send(1, *sink, reader), 1U);
  }
  sink.reset();  // the file is whole
  BackgroundProgram tshark(folder_, "tshark",
                           "-r " + cli::quoted(capture) +
                               " -Y rtps.param.topicName -T fields -e rtps.param.topicName -e "
                               "rtps.param.typeName",
                           "tshark");
  EXPECT_THAT(tshark.end().out,
              testing::HasSubstr(std::string(kTopic) + "\tsensor_msgs::msg::dds_::PointCloud2_"));
}

}  // namespace
}  // namespace terracut::interop
