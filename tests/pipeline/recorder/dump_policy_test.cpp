// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/dump_policy.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace terracut::test {
namespace {

using recorder::DumpLimits;
using recorder::DumpPolicy;
using recorder::DumpReason;
using recorder::DumpRefusal;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class DumpPolicyTest : public testing::Test {
 protected:
  static DumpLimits limits() {
    DumpLimits limits;
    limits.folder.folder = "never made";
    return limits;
  }
  static bool admits(DumpPolicy& policy, DumpReason reason, std::int64_t at_s) {
    const auto admitted = policy.admit(reason, at_s * kSecond_ns);
    if (!admitted) {
      EXPECT_EQ(admitted.error().refusal, DumpRefusal::kTooSoon);
    }
    return admitted.has_value();
  }
  static bool admits_missed(DumpPolicy& policy, std::int64_t at_s) {
    return admits(policy, DumpReason::kMissedDeadline, at_s);
  }
  static std::uint64_t too_soon(const DumpPolicy& policy) {
    return policy.counters().refused[static_cast<std::size_t>(DumpRefusal::kTooSoon)];
  }
};

TEST_F(DumpPolicyTest, WritesAtMostOneDumpAMinuteForMissedDeadlines) {
  DumpPolicy policy(limits());
  int admitted = 0;
  for (std::int64_t at_s = 7; at_s < 7 + 600; ++at_s) admitted += admits_missed(policy, at_s);
  EXPECT_EQ(admitted, 10);
  EXPECT_EQ(too_soon(policy), 590U);
  EXPECT_EQ(policy.counters().wanted[0], 600U);
}

TEST_F(DumpPolicyTest, GrantsABurstAndSavesUpNoMoreThanThat) {
  DumpLimits three = limits();
  three.missed_deadline = {.interval_s = 10, .burst = 3};
  DumpPolicy policy(three);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(admits_missed(policy, 100));
  EXPECT_FALSE(admits_missed(policy, 100));
  EXPECT_FALSE(admits_missed(policy, 109));
  EXPECT_TRUE(admits_missed(policy, 110));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(admits_missed(policy, 10'000));
  EXPECT_FALSE(admits_missed(policy, 10'000));
}

TEST_F(DumpPolicyTest, WhoAsksIsNotRefusedForAMissedDeadline) {
  DumpPolicy policy(limits());
  EXPECT_TRUE(admits_missed(policy, 0));
  EXPECT_FALSE(admits_missed(policy, 1));
  EXPECT_TRUE(admits(policy, DumpReason::kAsked, 1));
}

TEST_F(DumpPolicyTest, AClockThatStoodStillGrantsNothing) {
  DumpPolicy policy(limits());
  EXPECT_TRUE(admits_missed(policy, 50));
  EXPECT_FALSE(admits_missed(policy, 50));
  EXPECT_FALSE(admits_missed(policy, 49));
}

TEST_F(DumpPolicyTest, SaysWhenTheNextIsAllowed) {
  DumpPolicy policy(limits());
  EXPECT_TRUE(admits_missed(policy, 0));
  const auto refused = policy.admit(DumpReason::kMissedDeadline, 15 * kSecond_ns);
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, testing::HasSubstr("45.0 s"));
}

TEST_F(DumpPolicyTest, RefusesRatesOutOfRange) {
  for (const recorder::DumpRate rate :
       {recorder::DumpRate{0, 1}, {-1, 1}, {2e6, 1}, {60, 0}, {60, 1001}}) {
    DumpLimits bad = limits();
    bad.asked = rate;
    EXPECT_THROW(DumpPolicy{bad}, std::invalid_argument) << rate.interval_s << " " << rate.burst;
  }
}

TEST_F(DumpPolicyTest, EveryRefusalHasAName) {
  for (std::size_t i = 0; i < recorder::kDumpRefusals; ++i) {
    EXPECT_NE(to_string(static_cast<DumpRefusal>(i)), "unknown");
  }
  EXPECT_EQ(to_string(static_cast<DumpRefusal>(recorder::kDumpRefusals)), "unknown");
}

}  // namespace
}  // namespace terracut::test
