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
constexpr std::int64_t kCutStart_ns = 40 * kMillisecond_ns;

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

/// The frame whose cut could not be stopped for `start_ns`.
void run_frame(DeadlineLadder& ladder, std::int64_t start_ns) {
  ASSERT_TRUE(begin(ladder, kLong_ns));
  const pipeline::CutBudget budget = ladder.budget();
  ASSERT_FALSE(expired(budget)) << "before the cut";
  compute(start_ns);
  ASSERT_FALSE(expired(budget)) << "in the cut";
  ladder.end({});
}

TEST(DeadlineLadder, SkipsAFrameThatIsDueAlready) {
  DeadlineLadder ladder(kLong_ns);
  EXPECT_FALSE(begin(ladder, -kMillisecond_ns));
  EXPECT_TRUE(begin(ladder, kLong_ns)) << "the next one has time";
}

TEST(DeadlineLadder, LeavesOutTheCutWhereItsStartAloneWouldBeTooLong) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, kCutStart_ns);
  ASSERT_TRUE(begin(ladder, kCutStart_ns * 3 / 4));
  EXPECT_TRUE(expired(ladder.budget()));
}

TEST(DeadlineLadder, StopsTheCutSoEarlyThatWhatStoppingCostsFits) {
  DeadlineLadder ladder(kLong_ns);
  // Begun in time, and stopped in the cut; again if this thread was held up before it.
  do {
    (void)begin(ladder, 5 * kMillisecond_ns);
  } while (expired(ladder.budget()));
  compute(10 * kMillisecond_ns);
  ASSERT_TRUE(expired(ladder.budget())) << "in the cut";
  compute(kCutStart_ns);
  ladder.end({});
  ASSERT_TRUE(begin(ladder, kCutStart_ns * 3 / 4));
  EXPECT_TRUE(expired(ladder.budget()));
}

TEST(DeadlineLadder, TriesTheCutAgainSomeTimeLater) {
  DeadlineLadder ladder(kLong_ns);
  run_frame(ladder, kCutStart_ns);
  int left_out = 0;
  // Due in what is a fraction of the cut's start: not a question of this machine's speed until
  // what was learned is down to that.
  while (left_out < 20'000) {
    if (!begin(ladder, kCutStart_ns * 3 / 4)) continue;  // this thread was held up
    if (!expired(ladder.budget())) break;
    ++left_out;
  }
  EXPECT_GT(left_out, 50);
  EXPECT_LT(left_out, 20'000);
}

TEST(DeadlineLadder, SkipsNotForEverAfterOneDearFrame) {
  DeadlineLadder ladder(kLong_ns);
  ASSERT_TRUE(begin(ladder, kLong_ns));
  StageTimes dear;
  dear.stage_ns[static_cast<std::size_t>(pipeline::Stage::kElevationMap)] = 1000 * kMillisecond_ns;
  ladder.end(dear);
  int skipped = 0;
  while (skipped < 20'000 && !begin(ladder, 500 * kMillisecond_ns)) ++skipped;
  EXPECT_GT(skipped, 0);
  EXPECT_LT(skipped, 20'000);
}

}  // namespace
}  // namespace terracut::cli
