// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/live_summary.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"
#include "watched_run.hpp"

namespace terracut::cli {
namespace {

TEST(LiveSummary, HoldsWhatWasCounted) {
  WatchedRun run;
  const auto json = live_summary(run.figures());
  EXPECT_EQ(json["terracut"], "1.2.3");
  EXPECT_EQ(json["deadline_ms"], 50.0);
  EXPECT_EQ(json["link"]["state"], "receiving");
  EXPECT_EQ(json["frames"]["count"], 100);
  EXPECT_DOUBLE_EQ(json["frames"]["per_second"], 10.0);
  EXPECT_EQ(json["frames"]["returns"], 10'000'000);
  EXPECT_EQ(json["frames"]["rungs"]["full"], 98);
  EXPECT_EQ(json["frames"]["rungs"]["coarse"], 1);
  EXPECT_EQ(json["frames"]["rungs"]["skipped"], 1);
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
  WatchedRun run;
  const auto json = live_summary(run.figures());
  std::uint64_t sum = 0;
  for (const auto& count : json["datagrams"]["outcomes"]) sum += count.get<std::uint64_t>();
  EXPECT_EQ(json["datagrams"]["received"], 34'802);
  EXPECT_EQ(sum, 34'802U);
  EXPECT_EQ(json["datagrams"]["outcomes"]["let_go"], 5);
}

TEST(LiveSummary, NamesTheBlindSectorWhileItIsKnown) {
  WatchedRun run;
  EXPECT_TRUE(live_summary(run.figures())["blind"].is_null());
  run.narrow_view();
  const auto json = live_summary(run.figures());
  EXPECT_EQ(json["blind"]["from_deg"], 270.12);
  EXPECT_EQ(json["blind"]["to_deg"], 89.9);
}

TEST(LiveSummary, HoldsTheVehiclesMotionAndWhatWasSaidOnItsBusWhereTheyAreAskedFor) {
  WatchedRun run;
  EXPECT_FALSE(live_summary(run.figures()).contains("motion"));
  EXPECT_FALSE(live_summary(run.figures()).contains("health"));
  run.hear_vehicle();
  const auto json = live_summary(run.figures());
  EXPECT_EQ(json["motion"]["bus"], "can0");
  EXPECT_EQ(json["motion"]["state"], "known");
  EXPECT_EQ(json["motion"]["samples"], 1034);
  EXPECT_EQ(json["motion"]["taken_out_frames"], 98);
  EXPECT_EQ(json["motion"]["no_ego_motion_frames"], 2);
  const auto& after_turn_ms = json["motion"]["newest_sample_after_turn_ms"];
  EXPECT_EQ(after_turn_ms["newest"], -4.0);
  EXPECT_EQ(after_turn_ms["min"], -13.0);
  EXPECT_EQ(after_turn_ms["mean"], -5.0);
  EXPECT_EQ(after_turn_ms["max"], 2.0);
  EXPECT_EQ(json["motion"]["faults"]["kernel_drops"], 7);
  EXPECT_EQ(json["health"]["sent"], 190);
  EXPECT_EQ(json["health"]["queue_full"], 10);
}

TEST(LiveSummary, HoldsThePercentilesOfEveryTime) {
  WatchedRun run;
  const auto ms = live_summary(run.figures())["ms"];
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

TEST(LiveSummary, IsWrittenWholeEvenIfATextIsNoUtf8) {
  WatchedRun run;
  run.figures().sensor = "HDL\xff";
  const auto folder = test::make_scratch_folder();
  ASSERT_TRUE(write_live_summary(folder / "summary.json", run.figures()));
  std::ifstream file(folder / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(file)["sensor"], "HDL\xef\xbf\xbd");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace terracut::cli
