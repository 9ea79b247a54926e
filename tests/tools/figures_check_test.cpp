// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/figures_check.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "rt/status_page.hpp"
#include "tools/cli/dashboard.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/live_summary.hpp"
#include "watched_run.hpp"

namespace terracut::cli {
namespace {

using Bytes = std::string;
constexpr std::int64_t kNow_ns = 1'800'000'000'000'000'000;

/// The figures that lie in these bytes, as a reader of a status page gets them.
std::unique_ptr<rt::MonitorSnapshot> figures_in(const Bytes& bytes) {
  auto figures = std::make_unique<rt::MonitorSnapshot>();
  std::memcpy(static_cast<void*>(figures.get()), bytes.data(), sizeof *figures);
  return figures;
}
Bytes bytes_of(const rt::MonitorSnapshot& figures) {
  return {reinterpret_cast<const char*>(&figures), sizeof figures};
}

/// Bytes in [begin, begin + count) become anything; numbers of a page are mostly 0 or huge then.
void scramble(Bytes& page, std::size_t begin, std::size_t count, std::mt19937_64& random) {
  for (std::size_t i = begin; i < std::min(begin + count, page.size()); ++i) {
    page[i] = static_cast<char>(random());
  }
}

/// Whatever passes the check is shown, in every way there is.
void show(const rt::MonitorSnapshot& figures) {
  EXPECT_NO_THROW({
    EXPECT_FALSE(dashboard(figures, kNow_ns, {.colours = true, .columns = 80}).empty());
    EXPECT_FALSE(json_text(live_summary(figures)).empty());
  });
}

TEST(FiguresCheck, TakesWhatALiveRunPublishes) {
  EXPECT_TRUE(are_possible(WatchedRun().figures()));
  EXPECT_TRUE(are_possible(rt::MonitorSnapshot{})) << "nothing was counted yet";
}

TEST(FiguresCheck, RefusesGarbage) {
  std::mt19937_64 random(18);  // NOLINT: the same pages every time
  Bytes page(sizeof(rt::MonitorSnapshot), '\0');
  for (int i = 0; i < 20; ++i) {
    scramble(page, 0, page.size(), random);
    EXPECT_FALSE(are_possible(*figures_in(page))) << i;
  }
}

TEST(FiguresCheck, LetsNothingPassThatCannotBeShown) {
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

TEST(FiguresCheck, RefusesABlindSectorThatIsNoAzimuth) {
  for (const std::int32_t cdeg : {-1, 36'000}) {
    WatchedRun run;
    run.narrow_view();
    EXPECT_TRUE(are_possible(run.figures()));
    run.figures().blind_to_cdeg = cdeg;
    EXPECT_FALSE(are_possible(run.figures())) << cdeg;
  }
}

/// The figures that broke the bars of the stages.
TEST(FiguresCheck, RefusesTimesThatAreNone) {
  const std::int64_t kMinus = -1;
  const Bytes sound = bytes_of(WatchedRun().figures());
  const auto figures = figures_in(sound);
  const auto offset = reinterpret_cast<const char*>(&figures->stage_cpu[0]) -
                      reinterpret_cast<const char*>(figures.get());
  const auto histogram_end = offset + static_cast<std::ptrdiff_t>(sizeof(rt::LogLinearHistogram));
  for (std::ptrdiff_t at = histogram_end - 24; at < histogram_end; at += 8) {  // min, max, sum
    Bytes page = sound;
    std::memcpy(page.data() + at, &kMinus, sizeof kMinus);
    EXPECT_FALSE(are_possible(*figures_in(page))) << at - offset;
  }
}

}  // namespace
}  // namespace terracut::cli
