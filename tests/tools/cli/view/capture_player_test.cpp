// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/view/capture_player.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "eight_frames.hpp"
#include "tests/support/no_threads.hpp"
#include "tests/support/rewritten_capture.hpp"
#include "tools/cli/view/played_capture.hpp"
#include "tools/cli/view/played_clouds.hpp"

namespace terracut::cli {
namespace {

using testing::ElementsAre;

/// A capture of eight frames, played by a script: each frame shown lets the next command be given.
class CapturePlayerTest : public EightFrames {
 protected:
  void SetUp() override {
    EightFrames::SetUp();
    open();
  }
  void open() {
    auto capture = LabelledCapture::open(options_, LabelledCapture::Makes::kPoints);
    ASSERT_TRUE(capture) << capture.error().message;
    capture_ = *std::move(capture);
    played_ =
        std::make_unique<PlayedCapture>(*capture_, options_, FrameTruth::open({}).value(), nullptr);
  }
  /// From the middle on its stamps are a minute older.
  void set_the_clock_back() {
    const std::filesystem::path back = folder_ / "back.pcap";
    std::int64_t first_ns = 0;
    test::rewrite_capture(options_.capture.file, back, [&](auto datagram, auto n, auto& write) {
      if (n == 0) first_ns = datagram.stamp_ns;
      if (datagram.stamp_ns - first_ns > 400'000'000) datagram.stamp_ns -= 60'000'000'000;
      write(datagram);
    });
    options_.capture.file = back;
    open();
  }
  /// Shows frames until the script is through.
  static void play(CapturePlayer& player, std::deque<std::string> script,
                   const std::function<void(const frame::FrameInfo&)>& on_frame) {
    const Status over = player.run([&](const publish::LabelledFrame& frame) -> Status {
      on_frame(frame.record.info);
      if (script.empty()) return fail(ErrorCode::kInvalidArgument, "the script is through");
      player.obey(parse_player_command(script.front()).value());
      script.pop_front();
      return {};
    });
    EXPECT_FALSE(over);
  }
  static std::vector<std::uint32_t> numbers(CapturePlayer& player, std::deque<std::string> script) {
    std::vector<std::uint32_t> numbers;
    play(player, std::move(script),
         [&](const frame::FrameInfo& info) { numbers.push_back(info.number); });
    return numbers;
  }
  /// Seconds from the capture's begin to each of them.
  std::vector<double> shown(CapturePlayer& player, std::deque<std::string> script) {
    std::vector<double> shown_s;
    play(player, std::move(script), [&](const frame::FrameInfo& info) {
      const auto shown_ns = capture_->since_begin_ns(info.first_packet_ns);
      shown_s.push_back(static_cast<double>(shown_ns) * 1e-9);
    });
    return shown_s;
  }
  std::unique_ptr<LabelledCapture> capture_;
  std::unique_ptr<PlayedCapture> played_;
};

TEST_F(CapturePlayerTest, ShowsThePlaceSoughtThoughAFrameIsJustBeingShown) {
  CapturePlayer player(*played_);
  const auto shown_s =
      shown(player, {R"({"playing": false, "seek_s": 0.5})", R"({"seek_s": 0.2})"});
  ASSERT_EQ(shown_s.size(), 3U);
  EXPECT_NEAR(shown_s[1], 0.5, 0.6 * kFrame_s);
  EXPECT_NEAR(shown_s[2], 0.2, 0.6 * kFrame_s);
}

TEST_F(CapturePlayerTest, TellsWhichFrameStandsAndWhetherASoughtOneIsStillToCome) {
  CapturePlayer player(*played_);
  std::vector<PlayerState> states;
  play(player, {R"({"playing": false, "seek_s": 0.5})", R"({"playing": true})", R"({"rate": 1})"},
       [&](const frame::FrameInfo&) { states.push_back(player.state()); });
  ASSERT_EQ(states.size(), 4U);
  EXPECT_FALSE(states[0].seeking);
  EXPECT_TRUE(states[1].seeking);
  EXPECT_FALSE(states[2].seeking);
  EXPECT_EQ(states[2].frame, 5U);
}

TEST_F(CapturePlayerTest, PlaysThoughNoThreadIsLeftToFindOutHowLongTheRecordingIs) {
  const test::NoThreads none;
  CapturePlayer player(*played_);
  EXPECT_EQ(player.state().duration_s, 0);
  EXPECT_EQ(shown(player, {R"({"step": true})"}).size(), 2U);
}

TEST_F(CapturePlayerTest, ShowsThePlaceSoughtThoughTheRecordingClockWasSetBack) {
  set_the_clock_back();
  CapturePlayer player(*played_);
  EXPECT_NEAR(player.state().duration_s, 8 * kFrame_s, 0.1 * kFrame_s);
  const auto shown_s =
      shown(player, {R"({"playing": false, "seek_s": 0.6})", R"({"seek_s": 0.2})"});
  ASSERT_EQ(shown_s.size(), 3U);
  EXPECT_NEAR(shown_s[1], 0.6, 0.6 * kFrame_s);
  EXPECT_NEAR(shown_s[2], 0.2, 0.6 * kFrame_s);
}

TEST_F(CapturePlayerTest, ShowsThePlaceSoughtBeforeItsFirstFrame) {
  CapturePlayer player(*played_);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.5})").value());
  const auto shown_s = shown(player, {});
  ASSERT_EQ(shown_s.size(), 1U);
  EXPECT_NEAR(shown_s[0], 0.5, 0.6 * kFrame_s);
}

TEST_F(CapturePlayerTest, StepsFromAPlaceThatIsStillSought) {
  CapturePlayer player(*played_);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.5})").value());
  player.obey(parse_player_command(R"({"step": true})").value());
  const auto shown_s = shown(player, {"{}"});
  ASSERT_EQ(shown_s.size(), 2U);
  EXPECT_NEAR(shown_s[0], 0.5, 0.6 * kFrame_s);
  EXPECT_NEAR(shown_s[1] - shown_s[0], kFrame_s, 0.3 * kFrame_s);
}

TEST_F(CapturePlayerTest, StepsOnceForEachStepThatIsToldWhileItStands) {
  CapturePlayer player(*played_);
  const auto shown_s = shown(player, {R"({"step": true})", R"({"step": true})"});
  ASSERT_EQ(shown_s.size(), 3U);
  EXPECT_NEAR(shown_s[1] - shown_s[0], kFrame_s, 0.3 * kFrame_s);
  EXPECT_NEAR(shown_s[2] - shown_s[1], kFrame_s, 0.3 * kFrame_s);
}

TEST_F(CapturePlayerTest, NumbersFramesAsTheirFilesWhereverItCameFrom) {
  CapturePlayer player(*played_);
  EXPECT_THAT(numbers(player, {R"({"playing": false, "step": true})", R"({"step": true})",
                               R"({"seek_s": 0})", R"({"seek_s": 0.1})", R"({"step": true})"}),
              ElementsAre(0, 1, 2, 0, 1, 2));
}

TEST_F(CapturePlayerTest, NumbersFramesBehindAPlaceThatItWentToByWhatLiesBefore) {
  CapturePlayer player(*played_);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.5})").value());
  EXPECT_THAT(numbers(player, {R"({"step": true})", R"({"seek_s": 0.3})", R"({"seek_s": 0.6})"}),
              ElementsAre(5, 6, 3, 6));
}

TEST_F(CapturePlayerTest, NumbersFramesOfAPartByTheWholeCapture) {
  options_.capture.start_s = 0.35;
  open();
  CapturePlayer player(*played_);
  player.obey(parse_player_command(R"({"playing": false, "step": true})").value());
  EXPECT_THAT(numbers(player, {R"({"step": true})"}), ElementsAre(3, 4))
      << "of the first there is the end";
}

TEST_F(CapturePlayerTest, BeginsAnewAtItsEndOrStandsThere) {
  CapturePlayer player(*played_);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.6})").value());
  EXPECT_THAT(numbers(player, {R"({"step": true})", R"({"step": true})"}), ElementsAre(6, 7, 0))
      << "a step more at the end";
  player.obey(parse_player_command(R"({"playing": true, "seek_s": 0.7, "rate": 20})").value());
  EXPECT_THAT(numbers(player, {"{}", "{}", R"({"loop": false, "seek_s": 0.7})"}),
              ElementsAre(7, 0, 1, 7));
  EXPECT_FALSE(player.state().at_end);
}

TEST_F(CapturePlayerTest, PlaysCloudsAndNumbersThemAsTheirFiles) {
  const auto clouds = folder_ / "clouds";
  std::filesystem::create_directory(clouds);
  for (PlayedFrame frame; played_->next();) {
    ASSERT_TRUE(played_->take(frame));
    write_cloud(clouds / fmt::format("{:06}.pcd", 10 + frame.record.info.number), frame);
  }
  auto played = PlayedClouds::open(clouds, options_, FrameTruth::open({}).value(), nullptr);
  ASSERT_TRUE(played) << played.error().message;
  CapturePlayer player(**played);
  EXPECT_NEAR(player.state().duration_s, 8 * kFrame_s, 1e-9);
  player.obey(parse_player_command(R"({"playing": false, "seek_s": 0.5})").value());
  EXPECT_THAT(numbers(player, {R"({"step": true})", R"({"seek_s": 0})", R"({"seek_s": 0.7})",
                               R"({"step": true})"}),
              ElementsAre(15, 16, 10, 17, 10));
}

}  // namespace
}  // namespace terracut::cli
