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

#include "cloud_pattern.hpp"
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
