// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/figures/dashboard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/status/loss_causes.hpp"
#include "tests/pipeline/status/watched_run.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string line_of(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(begin)) return line;
  }
  return "no line '" + begin + "'";
}

constexpr std::int64_t kNow_ns = status::WatchedRun::kEnd_ns + 100 * status::WatchedRun::kMs;

TEST(Dashboard, ShowsRateDeadlineLevelsLossesAndFaults) {
  status::WatchedRun run;
  const std::string text = dashboard(run.figures(), kNow_ns, {});
  EXPECT_EQ(line_of(text, "up "), "up        00:00:10");
  EXPECT_THAT(line_of(text, "link"), HasSubstr("receiving on 127.0.0.1:2368"));
  EXPECT_EQ(line_of(text, "frames"), "frames    100, 10.00 a second, 10000000 returns");
  EXPECT_EQ(
      line_of(text, "deadline"),
      "deadline  50.0 ms, 2 missed (2.000 %): own_work 1, waiting_for_core 1, 2 in a row at most");
  EXPECT_EQ(line_of(text, "levels"), "levels    full 98, cut_stopped 0, coarse 1, skipped 1");
  EXPECT_EQ(line_of(text, "losses"),
            "losses    network_gap_packets 12, rejected_wrong_size 13, skipped_frames 1");
  EXPECT_EQ(line_of(text, "thread    segment"),
            "thread    segment   FIFO 70, core 3, 5 page faults");
  EXPECT_THAT(line_of(text, "latency"), HasSubstr("81.000"));
}

TEST(Dashboard, ShowsWhetherTheVehiclesMotionIsKnownAndWhatWasSaidOnItsBus) {
  status::WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("motion")));
  run.hear_vehicle();
  const std::string text = dashboard(run.figures(), kNow_ns, {.columns = 80});
  EXPECT_THAT(
      text,
      HasSubstr("motion    known on can0: 98 frames deskewed, no ego motion in 2, kernel_drops 7,\n"
                "          newest sample -4.0 ms from its frame's end, mean -5.0 ms (-13.0\n"
                "          to +2.0 ms)\n"
                "health    190 CAN frames sent on can1, 10 left out: queue full\n"));
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {.colours = true}),
              Not(HasSubstr("\x1b[31mknown")));
  run.figures().motion.state = status::MotionState::kBusOff;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {.colours = true}), HasSubstr("\x1b[31mbus_off"));
}

TEST(Dashboard, NamesTheBlindSectorWhileItIsKnown) {
  status::WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("blind")));
  run.narrow_view();
  EXPECT_EQ(line_of(dashboard(run.figures(), kNow_ns, {}), "blind"),
            "blind     from 270.1 to 89.9 deg of the head");
}

TEST(Dashboard, ShowsHowFarOffAClockIsThatFitsNoFrame) {
  status::WatchedRun run;
  run.figures().motion.bus = "can0";
  run.figures().motion.state = status::MotionState::kKnown;
  run.figures().motion.no_ego_motion = 100;
  run.figures().motion.newest_sample_after_frame_ns = -37'000 * status::WatchedRun::kMs;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}),
              HasSubstr("newest sample -37000.0 ms from its frame's end"));
}

TEST(Dashboard, TellsWhatThoseWhoLookOnDidNotGetFromLosses) {
  status::WatchedRun run;
  run.figures().loss_count = 0;
  status::show_losses(std::vector<status::NamedCount>{{"view_frames_skipped_by_browsers", 55},
                                                      {"unviewed_frames", 35}},
                      run.figures());
  const std::string text = dashboard(run.figures(), kNow_ns, {});
  EXPECT_EQ(line_of(text, "losses"), "losses    none");
  EXPECT_EQ(line_of(text, "onlookers"),
            "onlookers view_frames_skipped_by_browsers 55, unviewed_frames 35");
}

TEST(Dashboard, DrawsTheLongestStageLongest) {
  status::WatchedRun run;
  const std::string text = dashboard(run.figures(), kNow_ns, {.columns = 100});
  const auto marks = [&](const std::string& stage) {
    const std::string line = line_of(text, stage);
    return std::count(line.begin(), line.end(), '#');
  };
  EXPECT_GT(marks("min_cut"), 2 * marks("elevation_map"));
  EXPECT_GT(marks("elevation_map"), marks("adjacent_points"));
}

TEST(Dashboard, KeepsWithinTheWidthOfTheTerminal) {
  status::WatchedRun run;
  run.hear_vehicle();
  for (const int columns : {80, 120}) {
    std::istringstream lines(dashboard(run.figures(), kNow_ns, {.columns = columns}));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), static_cast<std::size_t>(columns)) << line;
    }
  }
}

TEST(Dashboard, UsesEscapeSequencesOnlyWithColours) {
  status::WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {.colours = true}), HasSubstr("\x1b[31m"));
}

TEST(Dashboard, LetsNoEscapeSequenceOfTheProcessThrough) {
  status::WatchedRun run;
  run.figures().sensor = "\x1b]0;evil\x07\xff";
  run.figures().losses[0] = {"\x1b[2J", 1};
  run.hear_vehicle();
  run.figures().motion.bus = "\x1b[2J";
  run.figures().motion.faults[0] = {"\x07", 1};
  run.figures().health.bus = "\x1b[2J";
  const std::string text = dashboard(run.figures(), kNow_ns, {});
  for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << int{c};
}

TEST(Dashboard, SeparatesWhatAThreadWasGrantedFromWhatItDid) {
  status::WatchedRun run;
  run.figures().threads[0].scheduling = "shared scheduling, core 0-1";
  EXPECT_THAT(line_of(dashboard(run.figures(), kNow_ns, {}), "thread    receive"),
              HasSubstr("shared scheduling, core 0-1, 0 page faults"));
}

TEST(ClosingLines, TellWhatWasCountedAndHowLongItTook) {
  status::WatchedRun run;
  const std::string text = closing_lines(run.figures());
  EXPECT_EQ(line_of(text, "levels"), "levels    full 98, cut_stopped 0, coarse 1, skipped 1");
  EXPECT_THAT(line_of(text, "latency"), HasSubstr("81.000"));
  EXPECT_THAT(text, Not(HasSubstr("ended")));
  run.figures().interrupted = 1;
  EXPECT_EQ(line_of(closing_lines(run.figures()), "ended"),
            "ended     interrupted before its --duration was over");
}

TEST(Dashboard, SaysWhenThereIsNoNews) {
  status::WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("no news")));
  EXPECT_THAT(dashboard(run.figures(), kNow_ns + 100'000 * status::WatchedRun::kMs, {}),
              HasSubstr("no news for 00:01:40"));
}

TEST(Dashboard, ShowsAProcessThatHasSeenNothingYetWithoutTablesOfZeros) {
  const auto figures = std::make_unique<status::MonitorSnapshot>();
  const std::string text = dashboard(*figures, kNow_ns, {});
  EXPECT_THAT(line_of(text, "link"), HasSubstr("waiting, no packet yet, 0 packets"));
  EXPECT_THAT(line_of(text, "losses"), HasSubstr("none"));
  for (const std::string& shown : {text, closing_lines(*figures)}) {
    EXPECT_THAT(shown, Not(HasSubstr("p50")));
    EXPECT_THAT(shown, Not(HasSubstr("levels")));
  }
}

TEST(Dashboard, TellsWhatCameBeforeLabellingBegan) {
  status::WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("before labelling")));
  run.figures().before_labelling = 8123;
  EXPECT_THAT(line_of(dashboard(run.figures(), kNow_ns, {}), "link"),
              HasSubstr("34800 packets, 8123 datagrams before labelling began"));
  run.figures().packets = 0;
  EXPECT_THAT(line_of(closing_lines(run.figures()), "link"), Not(HasSubstr("0 packets")));
}

TEST(WhyNoFrames, IsThatAllCameBeforeLabellingBeganOrThatNothingCame) {
  const auto figures = std::make_unique<status::MonitorSnapshot>();
  EXPECT_THAT(why_no_frames(*figures), HasSubstr("no datagram came in"));
  figures->before_labelling = 10'418;
  EXPECT_THAT(why_no_frames(*figures),
              HasSubstr("all 10418 datagrams came before labelling began"));
  figures->received = 5;
  EXPECT_THAT(why_no_frames(*figures), HasSubstr("out of 5 datagrams"));
}

}  // namespace
}  // namespace terracut::cli
