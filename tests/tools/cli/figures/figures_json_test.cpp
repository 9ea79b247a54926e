// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/figures/figures_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/pipeline/status/watched_run.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

nlohmann::json summary_of(status::WatchedRun& run) {
  return nlohmann::json::parse(json_text(live_summary(run.figures())));
}

TEST(LiveSummary, HoldsWhatWasCounted) {
  status::WatchedRun run;
  const auto json = summary_of(run);
  EXPECT_EQ(json["terracut"], "1.2.3");
  EXPECT_EQ(json["deadline_ms"], 50.0);
  EXPECT_EQ(json["link"]["state"], "receiving");
  EXPECT_EQ(json["frames"]["count"], 100);
  EXPECT_DOUBLE_EQ(json["frames"]["per_second"], 10.0);
  EXPECT_EQ(json["frames"]["returns"], 10'000'000);
  EXPECT_EQ(json["frames"]["levels"]["full"], 98);
  EXPECT_EQ(json["frames"]["levels"]["coarse"], 1);
  EXPECT_EQ(json["frames"]["levels"]["skipped"], 1);
  EXPECT_EQ(json["misses"]["total"], 2);
  EXPECT_EQ(json["misses"]["longest_run"], 2);
  EXPECT_EQ(json["misses"]["causes"]["waiting_for_core"], 1);
  EXPECT_EQ(json["misses"]["causes"]["own_work"], 1);
  EXPECT_EQ(json["misses"]["causes"]["stolen_time"], 0);
  EXPECT_EQ(json["losses"]["network_gap_packets"], 12);
  EXPECT_EQ(json["losses"]["kernel_drops"], 0);
  EXPECT_EQ(json["threads"][1]["name"], "segment");
  EXPECT_EQ(json["threads"][1]["minor_faults"], 5);
}

TEST(LiveSummary, TellsWhereEachDatagramWent) {
  status::WatchedRun run;
  const auto json = summary_of(run);
  std::uint64_t sum = 0;
  for (const auto& count : json["datagrams"]["outcomes"]) sum += count.get<std::uint64_t>();
  EXPECT_EQ(json["datagrams"]["received"], 34'802);
  EXPECT_EQ(sum, 34'802U);
  EXPECT_EQ(json["datagrams"]["outcomes"]["let_go"], 5);
}

TEST(LiveSummary, NamesTheBlindSectorWhileItIsKnown) {
  status::WatchedRun run;
  EXPECT_TRUE(summary_of(run)["blind"].is_null());
  run.narrow_view();
  const auto json = summary_of(run);
  EXPECT_EQ(json["blind"]["from_deg"], 270.12);
  EXPECT_EQ(json["blind"]["to_deg"], 89.9);
}

TEST(LiveSummary, HoldsTheVehiclesMotionAndWhatWasSaidOnItsBusWhereTheyAreAskedFor) {
  status::WatchedRun run;
  EXPECT_FALSE(summary_of(run).contains("motion"));
  EXPECT_FALSE(summary_of(run).contains("health"));
  run.hear_vehicle();
  const auto json = summary_of(run);
  EXPECT_EQ(json["motion"]["bus"], "can0");
  EXPECT_EQ(json["motion"]["state"], "known");
  EXPECT_EQ(json["motion"]["samples"], 1034);
  EXPECT_EQ(json["motion"]["deskewed_frames"], 98);
  EXPECT_EQ(json["motion"]["no_ego_motion_frames"], 2);
  const auto& after_frame_ms = json["motion"]["newest_sample_after_frame_ms"];
  EXPECT_EQ(after_frame_ms["newest"], -4.0);
  EXPECT_EQ(after_frame_ms["min"], -13.0);
  EXPECT_EQ(after_frame_ms["mean"], -5.0);
  EXPECT_EQ(after_frame_ms["max"], 2.0);
  EXPECT_EQ(json["motion"]["faults"]["kernel_drops"], 7);
  EXPECT_EQ(json["health"]["sent"], 190);
  EXPECT_EQ(json["health"]["queue_full"], 10);
}

TEST(LiveSummary, HoldsThePercentilesOfEveryTime) {
  status::WatchedRun run;
  const auto ms = summary_of(run)["ms"];
  EXPECT_EQ(ms["latency"]["count"], 99);  // one was skipped
  EXPECT_NEAR(ms["latency"]["p50"].get<double>(), 11.0, 11.0 / 128);
  EXPECT_NEAR(ms["latency"]["p90"].get<double>(), 11.0, 11.0 / 128);
  EXPECT_EQ(ms["latency"]["max"], 81.0);
  EXPECT_NEAR(ms["wall"]["p50"].get<double>(), 10.0, 10.0 / 128);
  EXPECT_NEAR(ms["cpu_total"]["p50"].get<double>(), 12.0, 12.0 / 128);
  EXPECT_EQ(ms["cpu_decode"]["max"], 4.0);
  EXPECT_EQ(ms["cpu_segment"]["max"], 8.0);
  EXPECT_EQ(ms["stages"]["min_cut"]["count"], 98);
  EXPECT_EQ(ms["stages"]["min_cut"]["max"], 5.0);
  EXPECT_EQ(ms["stages"]["elevation_map"]["mean"], 2.0);
}

TEST(LiveSummary, HasAnEmptyListOfThreadsBeforeTheyRun) {
  status::WatchedRun run;
  run.figures().thread_count = 0;
  EXPECT_EQ(summary_of(run)["threads"], nlohmann::json::array());
}

TEST(LiveSummary, IsJsonEvenIfATextIsNoUtf8) {
  status::WatchedRun run;
  run.figures().sensor = "HDL\xff";
  EXPECT_EQ(summary_of(run)["sensor"], "HDL\xef\xbf\xbd");
}

TEST(LiveSummary, TellsWhereTheGroundShowsTheSensorWhereThatIsElsewhere) {
  status::WatchedRun run;
  run.figures().mount.height_m = 1.7;
  EXPECT_EQ(summary_of(run)["mount"]["height_m"], 1.7);
  EXPECT_EQ(summary_of(run)["mount"]["contradicted"], false);
  EXPECT_FALSE(summary_of(run)["mount"].contains("seen"));
  run.figures().mount.contradicted = 1;
  run.figures().mount.seen_height_m = 1.9;
  run.figures().mount.seen_pitch_deg = -2.5;
  EXPECT_EQ(summary_of(run)["mount"]["seen"]["pitch_deg"], -2.5);
}

}  // namespace
}  // namespace terracut::cli
