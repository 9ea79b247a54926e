// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/view/capture_player.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/simulator/drive.hpp"
#include "tools/lab/velodyne/velodyne_encoder_traits.hpp"

namespace terracut::cli {
namespace {

using Traits = velodyne::Vlp16EncoderTraits;

constexpr double kFrame_s = 0.1;

/// A capture of eight frames, played by a script: each frame shown lets the next command be given.
class PlayedCapture : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::make_scratch_folder();
    options_.capture.file = folder_ / "drive.pcap";
    options_.mount.height_m = 1.73;
    simulator::SimulationConfig<Traits> config;
    config.scene = "flat";
    config.duration_s = 8 * kFrame_s;
    auto writer = drive::DriveWriter<Traits>::create(options_.capture.file, config.calibration);
    ASSERT_TRUE(writer) << writer.error().message;
    const auto done = simulator::simulate_drive(
        config, [&](const simulator::SimulatedColumn<Traits>& column) -> Status {
          return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                    column.wire.by_laser);
        });
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_TRUE(writer->finish());
    open();
  }
  void open() {
    auto capture = LabelledCapture::open(options_, FramesAreFor::kPoints);
    ASSERT_TRUE(capture) << capture.error().message;
    capture_ = *std::move(capture);
  }
  /// From the middle on its stamps are a minute older.
  void set_the_clock_back() {
    auto source = capture::PcapSource::open(options_.capture.file);
    ASSERT_TRUE(source);
    options_.capture.file = folder_ / "back.pcap";
    auto writer = capture::PcapWriter::create(options_.capture.file);
    ASSERT_TRUE(writer);
    std::int64_t first_ns = 0;
    while (const auto next = *source->next()) {
      decode::Datagram datagram = *next;
      if (first_ns == 0) first_ns = datagram.stamp_ns;
      if (datagram.stamp_ns - first_ns > 400'000'000) datagram.stamp_ns -= 60'000'000'000;
      ASSERT_TRUE(writer->write(datagram));
    }
    ASSERT_TRUE(writer->finish());
    open();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Seconds from the capture's begin to each frame that is shown, until the script is through.
  std::vector<double> shown(CapturePlayer& player, std::deque<std::string> script) {
    std::vector<double> shown_s;
    const Status over =
        player.run([&](const run::Frame& frame, std::span<const frame::Label>) -> Status {
          const auto shown_ns = capture_->since_begin_ns(frame.record.info.first_packet_ns);
          shown_s.push_back(static_cast<double>(shown_ns) * 1e-9);
          if (script.empty()) return fail(ErrorCode::kInvalidArgument, "the script is through");
          player.obey(parse_player_command(script.front()).value());
          script.pop_front();
          return {};
        });
    EXPECT_FALSE(over);
    return shown_s;
  }

  std::filesystem::path folder_;
  Options options_;
  std::unique_ptr<LabelledCapture> capture_;
};

TEST_F(PlayedCapture, ShowsThePlaceSoughtThoughAFrameIsJustBeingShown) {
  CapturePlayer player(*capture_, options_.capture);
  const auto shown_s =
      shown(player, {R"({"playing": false, "seek_s": 0.5})", R"({"seek_s": 0.2})"});
  ASSERT_EQ(shown_s.size(), 3U);
  EXPECT_NEAR(shown_s[1], 0.5, 0.6 * kFrame_s);
  EXPECT_NEAR(shown_s[2], 0.2, 0.6 * kFrame_s);
}

TEST_F(PlayedCapture, ShowsThePlaceSoughtThoughTheRecordingClockWasSetBack) {
  set_the_clock_back();
  CapturePlayer player(*capture_, options_.capture);
  EXPECT_NEAR(player.state().duration_s, 8 * kFrame_s, 0.1 * kFrame_s);
  const auto shown_s =
      shown(player, {R"({"playing": false, "seek_s": 0.6})", R"({"seek_s": 0.2})"});
  ASSERT_EQ(shown_s.size(), 3U);
  EXPECT_NEAR(shown_s[1], 0.6, 0.6 * kFrame_s);
  EXPECT_NEAR(shown_s[2], 0.2, 0.6 * kFrame_s);
}

TEST_F(PlayedCapture, ShowsThePlaceSoughtBeforeItsFirstFrame) {
  CapturePlayer player(*capture_, options_.capture);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.5})").value());
  const auto shown_s = shown(player, {});
  ASSERT_EQ(shown_s.size(), 1U);
  EXPECT_NEAR(shown_s[0], 0.5, 0.6 * kFrame_s);
}

TEST_F(PlayedCapture, StepsFromAPlaceThatIsStillSought) {
  CapturePlayer player(*capture_, options_.capture);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.5})").value());
  player.obey(parse_player_command(R"({"step": true})").value());
  const auto shown_s = shown(player, {"{}"});
  ASSERT_EQ(shown_s.size(), 2U);
  EXPECT_NEAR(shown_s[0], 0.5, 0.6 * kFrame_s);
  EXPECT_NEAR(shown_s[1] - shown_s[0], kFrame_s, 0.3 * kFrame_s);
}

TEST_F(PlayedCapture, StepsOnceForEachStepThatIsToldWhileItStands) {
  CapturePlayer player(*capture_, options_.capture);
  const auto shown_s = shown(player, {R"({"step": true})", R"({"step": true})"});
  ASSERT_EQ(shown_s.size(), 3U);
  EXPECT_NEAR(shown_s[1] - shown_s[0], kFrame_s, 0.3 * kFrame_s);
  EXPECT_NEAR(shown_s[2] - shown_s[1], kFrame_s, 0.3 * kFrame_s);
}

}  // namespace
}  // namespace terracut::cli
