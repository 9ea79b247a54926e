// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/miss_cause.hpp"

#include <gtest/gtest.h>

namespace terracut::rt {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kBudget_ns = 90 * kMs;

TEST(MissCause, IsNoneInTime) {
  EXPECT_EQ(name_miss_cause({.wall_ns = kBudget_ns, .cpu_ns = kBudget_ns}, 0, kBudget_ns),
            MissCause::kNone);
}

TEST(MissCause, IsOwnWorkWhenACoreOfItsOwnWouldNotHaveHelped) {
  EXPECT_EQ(name_miss_cause({.wall_ns = 300 * kMs,
                             .cpu_ns = 91 * kMs,
                             .waited_ns = 209 * kMs,
                             .involuntary_switches = 50},
                            0, kBudget_ns),
            MissCause::kOwnWork);
}

TEST(MissCause, IsWaitingWhenOthersHadTheCore) {
  EXPECT_EQ(name_miss_cause({.wall_ns = 100 * kMs,
                             .cpu_ns = 40 * kMs,
                             .waited_ns = 50 * kMs,
                             .voluntary_switches = 1,
                             .involuntary_switches = 9},
                            0, kBudget_ns),
            MissCause::kWaitedForACore);
}

TEST(MissCause, IsSleepWhenItWentToSleep) {
  EXPECT_EQ(
      name_miss_cause(
          {.wall_ns = 100 * kMs, .cpu_ns = 40 * kMs, .waited_ns = 5 * kMs, .voluntary_switches = 3},
          0, kBudget_ns),
      MissCause::kSlept);
}

TEST(MissCause, IsStolenTimeWhenItNeitherWorkedNorWaitedNorSlept) {
  EXPECT_EQ(name_miss_cause({.wall_ns = 100 * kMs, .cpu_ns = 40 * kMs, .waited_ns = 5 * kMs}, 0,
                            kBudget_ns),
            MissCause::kStolenTime);
}

TEST(MissCause, IsStolenTimeWhenTheHostTookMostOfTheRestThoughItSleptABit) {
  EXPECT_EQ(name_miss_cause({.wall_ns = 100 * kMs, .cpu_ns = 40 * kMs, .voluntary_switches = 1},
                            40 * kMs, kBudget_ns),
            MissCause::kStolenTime);
}

TEST(MissCause, IsGuessedFromTheTurnsOfOthersWhereWaitingIsNotTold) {
  EXPECT_EQ(name_miss_cause({.wall_ns = 100 * kMs, .cpu_ns = 40 * kMs, .involuntary_switches = 2},
                            0, kBudget_ns),
            MissCause::kWaitedForACore);
}

TEST(MissCause, HasWordsForReports) {
  EXPECT_EQ(to_string(MissCause::kWaitedForACore), "waited for a core");
  EXPECT_EQ(to_string(MissCause::kStolenTime), "stolen time");
}

}  // namespace
}  // namespace terracut::rt
