// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/figure_lines.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace terracut::status {
namespace {

using Figures = std::vector<Figure>;

TEST(FigureLines, JoinTheFiguresOfALineByCommas) {
  const Figures figures{{"a", std::uint64_t{3}, {}, {"link", "{} packets"}},
                        {"b", Duration{1'234'567'000'000}, {}, {"link", "silent for {s:.3f} s"}},
                        {"c", Duration{-2'500'000}, {}, {"link", " ({ms:+.1f} ms)"}},
                        {"d", Number{9.876, 0, 10}, {}, {"frames", "{:.1f} /s"}}};
  EXPECT_EQ(figure_lines(figures, {}),
            "link      3 packets, silent for 1234.567 s (-2.5 ms)\nframes    9.9 /s\n");
}

TEST(FigureLines, LeaveOutWhatIsShownOnlyIfThereIsAny) {
  const Counts none{"cause", {{"late", 0}}}, some{"cause", {{"late", 0}, {"lost", 2}}};
  const Phrase if_any{"x", "{}", Shown::kIfAny}, or_none{"x", "{}", Shown::kAlarmOrNone};
  EXPECT_EQ(figure_lines(Figures{{"a", none, {}, if_any}}, {}), "");
  EXPECT_EQ(figure_lines(Figures{{"a", none, {}, or_none}}, {}), "x         none\n");
  EXPECT_EQ(figure_lines(Figures{{"a", some, {}, or_none}}, {}), "x         lost 2\n");
  EXPECT_EQ(figure_lines(Figures{{"a", some, {}, {"x"}}}, {}), "x         late 0, lost 2\n");
}

TEST(FigureLines, BreakBetweenFiguresWhereALineIsFull) {
  const Phrase phrase{"x", "0123456789"};
  const Figures figures{{"a", true, {}, phrase}, {"b", true, {}, phrase}};
  EXPECT_EQ(figure_lines(figures, {.columns = 33}), "x         0123456789, 0123456789\n");
  EXPECT_EQ(figure_lines(figures, {.columns = 32}),
            "x         0123456789,\n          0123456789\n");
}

TEST(FigureLines, BreakBetweenWordsWhatIsLongerThanALine) {
  const Figures figures{{"a", std::string("one two three four"), {}, {"x"}}};
  EXPECT_EQ(figure_lines(figures, {.columns = 21}), "x         one two\n          three four\n");
}

TEST(FigureLines, ColourAlarms) {
  const Figures figures{{"a", std::uint64_t{1}, {}, {"x", "{} lost", Shown::kAlarm}},
                        {"b", std::uint64_t{0}, {}, {"x", "{} late", Shown::kAlarmOrNone}}};
  EXPECT_EQ(figure_lines(figures, {.colours = true}), "x         \x1b[31m1 lost\x1b[0m, none\n");
}

}  // namespace
}  // namespace terracut::status
