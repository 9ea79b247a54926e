// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/stolen_time_share.hpp"

#include <gtest/gtest.h>

namespace terracut::status {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000 * kMs;

/// What was stolen by now, and how often that was asked.
struct Host {
  std::int64_t stolen_ns = 0;
  int readings = 0;
};
struct MadeStolenTime {
  Host* host;
  [[nodiscard]] std::optional<std::int64_t> read_ns() const {
    ++host->readings;
    return host->stolen_ns;
  }
};

TEST(StolenTimeShareTest, IsReadAFewTimesASecondHoweverManyFramesThereAre) {
  Host host;
  StolenTimeShare<MadeStolenTime> share({&host});
  for (std::int64_t ms = 0; ms < 10'000; ++ms) share.work_round(kStart_ns + ms * kMs);
  EXPECT_EQ(host.readings, 40);
  const int before = host.readings;
  share.work_round(kStart_ns - 3'600'000 * kMs);
  EXPECT_EQ(host.readings, before + 1) << "the clock was set back";
}

TEST(StolenTimeShareTest, ChargesAFrameWithWhatWasTakenAroundItAndNothingEarlier) {
  Host host;
  StolenTimeShare<MadeStolenTime> share({&host});
  host.stolen_ns = 700 * kMs;
  for (int round = 0; round < 20; ++round) share.work_round(kStart_ns + round * 50 * kMs);
  host.stolen_ns += 80 * kMs;
  EXPECT_EQ(share.since(kStart_ns + 960 * kMs, kStart_ns + 1060 * kMs), 80 * kMs);
  EXPECT_EQ(share.since(kStart_ns + 1060 * kMs, kStart_ns + 1100 * kMs), 0);
}

TEST(StolenTimeShareTest, KnowsOfNoTimeBeforeItsFirstReading) {
  Host host{.stolen_ns = 5000 * kMs};
  StolenTimeShare<MadeStolenTime> share({&host});
  EXPECT_EQ(share.since(kStart_ns - 100 * kMs, kStart_ns), 0);
}

}  // namespace
}  // namespace terracut::status
