// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Frames are due long after any machine is done with them, or were due long ago: how fast this one
// is decides nothing.
#include "tools/cli/live/deadline_ladder.hpp"

#include <gtest/gtest.h>

namespace terracut::cli {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kLong_ns = 1'000'000 * kMillisecond_ns;
constexpr std::int64_t kDear_ns = 40 * kMillisecond_ns;

/// A ladder whose frames are due `left_ns` from now.
bool begin(DeadlineLadder& ladder, std::int64_t left_ns) {
  return ladder.begin(rt::realtime_ns() + left_ns - kLong_ns);
}
bool expired(const pipeline::CutBudget& budget) {
  return budget.expired(budget.context);
}
void compute(std::int64_t for_ns) {
  const std::int64_t end_ns = rt::thread_cpu_ns() + for_ns;
  while (rt::thread_cpu_ns() < end_ns) {
  }
}
StageTimes spent_in(pipeline::Stage stage, std::int64_t time_ns) {
  StageTimes times;
  times.stage_ns[static_cast<std::size_t>(stage)] = time_ns;
  return times;
}

/// A frame with all the time there is, whose cut was begun.
void run_frame(DeadlineLadder& ladder, const StageTimes& times,
               const pipeline::SegmentationReport& report, std::int64_t handing_on_ns = 0) {
  ASSERT_TRUE(begin(ladder, kLong_ns));
  const pipeline::CutBudget budget = ladder.budget();
  ASSERT_FALSE(expired(budget)) << "before the cut";
  ASSERT_FALSE(expired(budget)) << "in the cut";
  ladder.end(times, report, handing_on_ns);
}
pipeline::SegmentationReport came_to_nothing() {
  pipeline::SegmentationReport report;
  report.last_stage = pipeline::Stage::kAdjacentPoints;
  report.cut.discarded = true;
  report.cut.coarse_by_budget = 1000;
  return report;
}

TEST(DeadlineLadder, SkipsAFrameThatIsDueAlready) {
  DeadlineLadder ladder(kLong_ns);
  EXPECT_FALSE(begin(ladder, -kMillisecond_ns));
  EXPECT_TRUE(begin(ladder, kLong_ns)) << "the next one has time";
}

TEST(DeadlineLadder, GivesTheFirstFrameTheWholeMethodWhereThereIsTime) {
  DeadlineLadder ladder(kLong_ns);
  ASSERT_TRUE(begin(ladder, kLong_ns));
  const pipeline::CutBudget budget = ladder.budget();
  EXPECT_FALSE(expired(budget)) << "before the cut";
  EXPECT_FALSE(expired(budget)) << "in the cut";
}

TEST(DeadlineLadder, SetsTimeAsideForAStoppedCutBeforeItHasSeenOne) {
  DeadlineLadder ladder(kLong_ns);
  do {  // again if this thread was held up
  } while (!begin(ladder, 2 * kMillisecond_ns));
  EXPECT_TRUE(expired(ladder.budget()));
}

TEST(DeadlineLadder, LeavesOutACutThatCameToNothingWithAsMuchTime) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, spent_in(pipeline::Stage::kMinCut, kDear_ns), came_to_nothing());
  ASSERT_TRUE(begin(ladder, kDear_ns));
  EXPECT_TRUE(expired(ladder.budget()));
}

TEST(DeadlineLadder, LeavesOutTheCutWhereItsSeedsAloneWouldBeTooLong) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, spent_in(pipeline::Stage::kSeeds, kDear_ns), {});
  ASSERT_TRUE(begin(ladder, kDear_ns));
  EXPECT_TRUE(expired(ladder.budget()));
}

TEST(DeadlineLadder, DoesNotTakeALongCutThatCameToAnEndForOneInVain) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, spent_in(pipeline::Stage::kMinCut, kLong_ns), {});
  ASSERT_TRUE(begin(ladder, kLong_ns / 2));
  EXPECT_FALSE(expired(ladder.budget()));
}

TEST(DeadlineLadder, StopsTheCutSoEarlyThatWhatStoppingCostsFits) {
  DeadlineLadder ladder(kLong_ns);
  // Begun in time, and stopped in the cut; again if this thread was held up before it.
  do {
    (void)begin(ladder, 8 * kMillisecond_ns);
  } while (expired(ladder.budget()));
  compute(10 * kMillisecond_ns);
  ASSERT_TRUE(expired(ladder.budget())) << "in the cut";
  compute(kDear_ns);
  ladder.end({}, {}, 0);
  ASSERT_TRUE(begin(ladder, kDear_ns * 3 / 4));
  EXPECT_TRUE(expired(ladder.budget()));
}

TEST(DeadlineLadder, CountsHandingOnTheLabelsToWhatAFrameTakes) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, {}, {}, kDear_ns);
  EXPECT_FALSE(begin(ladder, kDear_ns)) << "not even the coarse stages fit";
}

TEST(DeadlineLadder, TriesTheCutAgainSomeTimeLater) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, spent_in(pipeline::Stage::kMinCut, kDear_ns), came_to_nothing());
  int left_out = 0;
  // Due in what is a fraction of what was in vain: not a question of this machine's speed until
  // what was learned is down to that.
  while (left_out < 20'000) {
    if (!begin(ladder, kDear_ns * 3 / 4)) continue;  // this thread was held up
    if (!expired(ladder.budget())) break;
    ++left_out;
  }
  EXPECT_GT(left_out, 50);
  EXPECT_LT(left_out, 20'000);
}

TEST(DeadlineLadder, SkipsNotForEverAfterOneDearFrame) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, spent_in(pipeline::Stage::kElevationMap, 1000 * kMillisecond_ns), {});
  int skipped = 0;
  while (skipped < 20'000 && !begin(ladder, 500 * kMillisecond_ns)) ++skipped;
  EXPECT_GT(skipped, 0);
  EXPECT_LT(skipped, 20'000);
}

TEST(DeadlineLadder, MarksAFrameByWhatItsLabelsAreOf) {
  pipeline::SegmentationReport report;
  EXPECT_EQ(DeadlineLadder::rung_of(report), rt::Rung::kFull);
  report.cut.coarse_by_budget = 1;
  EXPECT_EQ(DeadlineLadder::rung_of(report), rt::Rung::kCutStopped);
  EXPECT_EQ(DeadlineLadder::rung_of(came_to_nothing()), rt::Rung::kCoarse);
}

}  // namespace
}  // namespace terracut::cli
