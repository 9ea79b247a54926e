// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/dashboard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "watched_run.hpp"

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

constexpr std::int64_t kNow_ns = WatchedRun::kEnd_ns + 100 * WatchedRun::kMs;

TEST(Dashboard, ShowsRateDeadlineRungsLossesAndFaults) {
  WatchedRun run;
  const std::string text = dashboard(run.figures(), kNow_ns, {});
  EXPECT_EQ(line_of(text, "up "), "up        00:00:10");
  EXPECT_THAT(line_of(text, "link"), HasSubstr("receiving on 127.0.0.1:2368"));
  EXPECT_THAT(line_of(text, "frames"), HasSubstr("10.00 /s, 100 so far"));
  EXPECT_EQ(line_of(text, "deadline"),
            "deadline  50.0 ms, 2 missed (2.000 %): own_work 1, waiting_for_core 1");
  EXPECT_EQ(line_of(text, "rungs"), "rungs     full 98, cut_stopped 0, coarse 1, skipped 1");
  EXPECT_EQ(line_of(text, "losses"), "losses    network_gap_packets 12, skipped_frames 1");
  EXPECT_THAT(line_of(text, "thread    segment"), HasSubstr("page faults 5 minor, 0 major"));
  EXPECT_THAT(line_of(text, "latency"), HasSubstr("81.000"));
}

TEST(Dashboard, DrawsTheLongestStageLongest) {
  WatchedRun run;
  const std::string text = dashboard(run.figures(), kNow_ns, {.columns = 100});
  const auto marks = [&](const std::string& stage) {
    const std::string line = line_of(text, stage);
    return std::count(line.begin(), line.end(), '#');
  };
  EXPECT_GT(marks("min_cut"), 2 * marks("elevation_map"));
  EXPECT_GT(marks("elevation_map"), marks("adjacent_points"));
}

TEST(Dashboard, KeepsWithinTheWidthOfTheTerminal) {
  WatchedRun run;
  for (const int columns : {80, 120}) {
    std::istringstream lines(dashboard(run.figures(), kNow_ns, {.columns = columns}));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), static_cast<std::size_t>(columns)) << line;
    }
  }
}

TEST(Dashboard, UsesEscapeSequencesOnlyWithColours) {
  WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {.colours = true}), HasSubstr("\x1b[31m"));
}

TEST(Dashboard, LetsNoEscapeSequenceOfTheProcessThrough) {
  WatchedRun run;
  run.figures().sensor = "\x1b]0;evil\x07\xff";
  run.figures().losses[0] = {"\x1b[2J", 1};
  const std::string text = dashboard(run.figures(), kNow_ns, {});
  for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << int{c};
}

TEST(Dashboard, SaysWhenThereIsNoNews) {
  WatchedRun run;
  EXPECT_THAT(dashboard(run.figures(), kNow_ns, {}), Not(HasSubstr("no news")));
  EXPECT_THAT(dashboard(run.figures(), kNow_ns + 100'000 * WatchedRun::kMs, {}),
              HasSubstr("no news for 00:01:40"));
}

TEST(Dashboard, ShowsAProcessThatHasSeenNothingYet) {
  const auto figures = std::make_unique<rt::MonitorSnapshot>();
  const std::string text = dashboard(*figures, kNow_ns, {});
  EXPECT_THAT(line_of(text, "link"), HasSubstr("waiting, no packet yet"));
  EXPECT_THAT(line_of(text, "losses"), HasSubstr("none"));
}

}  // namespace
}  // namespace terracut::cli
