// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A few seeds of ./tools/simulate_live, which runs for as long as one likes.
#include <gtest/gtest.h>

#include "tests/simulation/simulated_run.hpp"
#include "tests/support/thinned.hpp"

namespace terracut::simulation {
namespace {

TEST(Simulation, HoldsForTheFirstSeeds) {
  for (std::uint64_t seed = 1; seed <= 20; seed += test::kThinning) {
    Plan plan = plan_of(seed);
    plan.has_real_method = plan.has_real_method && seed <= 10;
    const Outcome outcome = simulate(plan);
    ASSERT_FALSE(outcome.broken) << "seed " << seed << ", " << *outcome.broken << "\n"
                                 << to_string(plan.faults);
    EXPECT_GT(outcome.frames_compared, 5U) << seed;
  }
}

TEST(Simulation, HoldsWhereATurnBeginsWithoutReturnsAndComesToNothing) {
  for (const bool has_real_method : {false, true}) {
    Plan plan = plan_of(1008);
    plan.has_real_method = has_real_method;
    plan.faults = *parse_faults(
        "cable_pulled@9033+461*0 head_stands@9098+1*0 head_stands@9137+4*0 duplicate@9158+0*41 "
        "head_stands@9320+1*0");
    const Outcome outcome = simulate(plan);
    EXPECT_FALSE(outcome.broken) << *outcome.broken;
  }
}

TEST(Simulation, IsTheSameEachTime) {
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    const Outcome first = simulate(plan_of(seed)), again = simulate(plan_of(seed));
    EXPECT_EQ(first.digest, again.digest) << seed;
    EXPECT_EQ(first.frames, again.frames) << seed;
  }
}

TEST(Simulation, FaultsAreReadAsTheyAreWritten) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Faults faults = faults_of(seed);
    const auto read = parse_faults(to_string(faults));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, faults);
  }
  EXPECT_FALSE(parse_faults("stolen_core@2000+250"));
  EXPECT_FALSE(parse_faults("earthquake@2000+250*0"));
}

}  // namespace
}  // namespace terracut::simulation
