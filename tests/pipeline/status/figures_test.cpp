// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/figures.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <variant>

#include "pipeline/status/figure_lines.hpp"
#include "tests/pipeline/status/watched_run.hpp"

namespace terracut::status {
namespace {

using Bytes = std::string;

/// The figures that lie in these bytes, as a reader of a status page gets them.
std::unique_ptr<MonitorSnapshot> figures_in(const Bytes& bytes) {
  auto figures = std::make_unique<MonitorSnapshot>();
  std::memcpy(static_cast<void*>(figures.get()), bytes.data(), sizeof *figures);
  return figures;
}
Bytes bytes_of(const MonitorSnapshot& figures) {
  return {reinterpret_cast<const char*>(&figures), sizeof figures};
}

/// Bytes in [begin, begin + count) become anything; numbers of a page are mostly 0 or huge then.
void scramble(Bytes& page, std::size_t begin, std::size_t count, std::mt19937_64& random) {
  for (std::size_t i = begin; i < std::min(begin + count, page.size()); ++i) {
    page[i] = static_cast<char>(random());
  }
}

/// A run in which there is everything.
struct WholeRun : WatchedRun {
  WholeRun() {
    narrow_view();
    hear_vehicle();
    figures().mount = {.frames = 9,
                       .contradicted = 1,
                       .height_m = 1.7,
                       .roll_deg = 0,
                       .pitch_deg = 0,
                       .found_in_frames = 10,
                       .seen_height_m = 2.1,
                       .seen_roll_deg = 1,
                       .seen_pitch_deg = -2};
    figures().sight.is_watched = figures().sight.has_learnt = 1;
    for (auto& sector : figures().sight.sectors) sector = {{}, 1, 30};
  }
};

TEST(Figures, StandEachInOnePlaceOfJson) {
  WholeRun run;
  std::set<std::string> places;
  for (const Figure& figure : figures_of(run.figures())) {
    if (figure.key.empty()) continue;
    EXPECT_TRUE(places.insert(figure.group + "." + std::string(figure.key)).second) << figure.key;
  }
  EXPECT_GT(places.size(), 50U);
}

TEST(Figures, SayThatTheViewIsBeingLearntAndThenHowItIs) {
  WholeRun run;
  const auto state = [&] {
    for (const Figure& figure : figures_of(run.figures())) {
      if (figure.group != "sight" || figure.key != "state") continue;
      const auto& value = std::get<State>(figure.value);
      return value.names[value.index];
    }
    return std::string_view();
  };
  EXPECT_EQ(state(), "clear");
  run.figures().sight.has_learnt = 0;
  EXPECT_EQ(state(), "learning");
}

TEST(Figures, NameTheUnitOfTimesInJsonAndInMetrics) {
  WholeRun run;
  for (const Figure& figure : figures_of(run.figures())) {
    const std::string_view key = figure.key, metric = figure.metric.name;
    const bool in_ms =
        key.ends_with("_ms") || figure.group.ends_with("_ms") || figure.group == "ms";
    if (std::holds_alternative<TimeOfDay>(figure.value)) {
      EXPECT_TRUE(key.ends_with("_ns")) << key;
      EXPECT_TRUE(metric.ends_with("_time_seconds")) << metric;
    } else if (std::holds_alternative<Duration>(figure.value) ||
               std::holds_alternative<Histogram>(figure.value) ||
               std::holds_alternative<Histograms>(figure.value)) {
      EXPECT_TRUE(in_ms || key.empty()) << key;
      EXPECT_TRUE(metric.empty() || metric.find("_seconds") != metric.npos) << metric;
    }
  }
}

TEST(Figures, ExplainEveryMetricAndNameEachSampleOnce) {
  WholeRun run;
  std::map<std::string, std::string_view> help;
  std::set<std::string> samples;
  for (const Figure& figure : figures_of(run.figures())) {
    if (figure.metric.name.empty()) continue;
    std::string sample(figure.metric.name);
    EXPECT_TRUE(sample.starts_with("terracut_"));
    const auto first = help.emplace(sample, figure.metric.help).first;
    EXPECT_EQ(first->second, figure.metric.help) << sample;
    EXPECT_FALSE(figure.metric.help.empty()) << sample;
    for (const auto& [label, value] : figure.metric.labels) {
      sample += " " + std::string(label) + "=" + value;
    }
    EXPECT_TRUE(samples.insert(sample).second) << sample;
  }
}

TEST(Figures, TellTheSensorsViewWhereItIsWatched) {
  WholeRun run;
  visibility::SightFigures& sight = run.figures().sight;
  sight.sectors[0].condition = {visibility::State::kReduced, visibility::Cause::kFog};
  const auto lines = [&] { return figure_lines(figures_of(sight), {}); };
  EXPECT_EQ(lines(), "sight     reduced, fog: 1 sector, ahead\n");
  sight.left_out_turns = 100;
  EXPECT_NE(lines().find("turns left out for want of packets: 100"), std::string::npos);
  EXPECT_TRUE(are_possible(run.figures()));
  sight.sectors[7].condition.state = visibility::State::kCount;
  EXPECT_FALSE(are_possible(run.figures())) << "no process has such a state";
  sight.is_watched = 0;
  EXPECT_TRUE(figures_of(sight).empty());
}

/// Whatever passes the check is shown.
void show(const MonitorSnapshot& figures) {
  EXPECT_NO_THROW(
      EXPECT_FALSE(figure_lines(figures_of(figures), {.colours = true, .columns = 80}).empty()));
}

TEST(Figures, TakesWhatALiveRunPublishes) {
  EXPECT_TRUE(are_possible(WatchedRun().figures()));
  EXPECT_TRUE(are_possible(MonitorSnapshot{})) << "nothing was counted yet";
}

TEST(Figures, RefusesGarbage) {
  std::mt19937_64 random(18);  // NOLINT: the same pages every time
  Bytes page(sizeof(MonitorSnapshot), '\0');
  for (int i = 0; i < 20; ++i) {
    scramble(page, 0, page.size(), random);
    EXPECT_FALSE(are_possible(*figures_in(page))) << i;
  }
}

TEST(Figures, LetsNothingPassThatCannotBeShown) {
  std::mt19937_64 random(18);  // NOLINT: the same pages every time
  const Bytes sound = bytes_of(WatchedRun().figures());
  int refused = 0;
  constexpr int kPages = 600;
  for (int i = 0; i < kPages; ++i) {
    Bytes page = sound;
    const std::size_t begin = random() % (i % 2 == 0 ? 8192 : page.size());  // its head is small
    scramble(page, begin, std::size_t{1} << random() % 16, random);
    const auto figures = figures_in(page);
    if (are_possible(*figures)) {
      show(*figures);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, kPages / 10);
}

TEST(Figures, RefusesNumbersAndTimesOutOfTheirRange) {
  constexpr std::int64_t kAge_ns = std::int64_t{1'000'000'000} * 86'400 * 365 * 200;
  for (const Value& value :
       {Value{Number{1, 2, 3}}, Value{Number{4, 2, 3}}, Value{TimeOfDay{-1}},
        Value{TimeOfDay{kAge_ns}}, Value{Duration{-kAge_ns}}, Value{Duration{kAge_ns}}}) {
    EXPECT_FALSE(is_possible(value));
  }
  for (const Value& value :
       {Value{Number{2, 2, 3}}, Value{Number{3, 2, 3}}, Value{TimeOfDay{0}}, Value{Duration{-1}}}) {
    EXPECT_TRUE(is_possible(value));
  }
}

TEST(Figures, RefusesABlindSectorThatIsNoAzimuth) {
  for (const std::int32_t cdeg : {-1, 36'000}) {
    WatchedRun run;
    run.narrow_view();
    EXPECT_TRUE(are_possible(run.figures()));
    run.figures().blind_to_cdeg = cdeg;
    EXPECT_FALSE(are_possible(run.figures())) << cdeg;
  }
}

/// The figures that broke the bars of the stages.
TEST(Figures, RefusesTimesThatAreNone) {
  const std::int64_t kMinus = -1;
  const Bytes sound = bytes_of(WatchedRun().figures());
  const auto figures = figures_in(sound);
  const auto offset = reinterpret_cast<const char*>(&figures->stage_cpu[0]) -
                      reinterpret_cast<const char*>(figures.get());
  const auto histogram_end =
      offset + static_cast<std::ptrdiff_t>(sizeof(measure::LogLinearHistogram));
  for (std::ptrdiff_t at = histogram_end - 24; at < histogram_end; at += 8) {  // min, max, sum
    Bytes page = sound;
    std::memcpy(page.data() + at, &kMinus, sizeof kMinus);
    EXPECT_FALSE(are_possible(*figures_in(page))) << at - offset;
  }
}

}  // namespace
}  // namespace terracut::status
