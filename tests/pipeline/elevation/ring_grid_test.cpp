// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/ring_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "tests/support/synthetic_frame.hpp"

namespace terracut::elevation {
namespace {

const frame::ImageShape kShape{64, 2083};
/// A band for each ring, however near or far they are.
constexpr RingGrid::Config kAsPrinted{.min_band_m = 0, .max_band_m = 1e9F};

TEST(RingGrid, WithoutMergingOrCuttingEveryRingThatReachesTheGroundHasABandOfItsOwn) {
  memory::FixedMemory memory;
  const mount::RingProfile profile = test::even_profile();
  const RingGrid grid(kAsPrinted, profile, kShape, memory);
  std::set<int> bands;
  int rings = 0;
  for (const mount::Ring& ring : profile.rings) {
    if (ring.ground_distance_m >= 100) continue;
    ++rings;
    bands.insert(grid.band_of(static_cast<float>(ring.ground_distance_m)));
  }
  EXPECT_EQ(static_cast<int>(bands.size()), rings);
}

TEST(RingGrid, BandsGrowOutwardsAndCoverEveryRange) {
  memory::FixedMemory memory;
  const RingGrid grid({}, test::even_profile(), kShape, memory);
  int last = 0;
  for (float range_m = 0; range_m < 300; range_m += 0.01F) {
    const int band = grid.band_of(range_m);
    ASSERT_GE(band, last);
    ASSERT_LE(band, last + 1) << "no band is left out at " << range_m;
    last = band;
  }
  EXPECT_EQ(last, grid.bands() - 1);
  EXPECT_EQ(grid.band_of(NAN), grid.bands() - 1);
  EXPECT_EQ(grid.band_of(INFINITY), grid.bands() - 1);
}

TEST(RingGrid, KeepsBandsWithinTheirLimits) {
  memory::FixedMemory memory;
  const RingGrid grid({}, test::even_profile(), kShape, memory);
  for (int band = 2; band < grid.bands(); ++band) {
    const float pitch_m = grid.center_m(band) - grid.center_m(band - 1);
    EXPECT_GT(pitch_m, 0.19F) << band;
    EXPECT_LT(pitch_m, 2.4F) << band;
  }
}

TEST(RingGrid, CutsWideBandsAndLeavesTheBlindZoneToItself) {
  memory::FixedMemory memory;
  RingGrid::Config config;
  config.min_band_m = 0;
  const mount::RingProfile profile = test::even_profile();
  const RingGrid grid(config, profile, kShape, memory);
  std::vector<float> width_m(static_cast<std::size_t>(grid.bands()));
  constexpr float kStep_m = 0.01F;
  for (float range_m = 0; range_m < 100; range_m += kStep_m) {
    width_m[static_cast<std::size_t>(grid.band_of(range_m))] += kStep_m;
  }
  const auto first_ring_m = static_cast<float>(profile.rings.front().ground_distance_m);
  EXPECT_NEAR(width_m[0], first_ring_m - 1, 0.05F) << "half a band before the first ring";
  for (std::size_t band = 1; band < width_m.size(); ++band) {
    EXPECT_LT(width_m[band], 2.05F) << band;
  }
}

TEST(RingGrid, MixesTheTwoBandsARangeLiesBetween) {
  memory::FixedMemory memory;
  RingGrid::Config config;
  config.min_band_m = 0;
  const RingGrid grid(config, test::even_profile(), kShape, memory);
  for (float range_m = 4; range_m < 99; range_m += 0.37F) {
    const RingGrid::BandMix mix = grid.mix_of(range_m);
    ASSERT_GE(mix.outer_share, 0.0F);
    ASSERT_LE(mix.outer_share, 1.0F);
    if (mix.outer_share == 0) continue;  // at the ends there is nothing to mix with
    const float inner_m = grid.center_m(mix.inner), outer_m = grid.center_m(mix.inner + 1);
    const float mixed_m = inner_m + mix.outer_share * (outer_m - inner_m);
    EXPECT_NEAR(mixed_m, range_m, 0.04F);
  }
}

TEST(RingGrid, SectorsShareTheColumnsEvenly) {
  memory::FixedMemory memory;
  const RingGrid grid(kAsPrinted, test::even_profile(), kShape, memory);
  std::vector<int> columns(static_cast<std::size_t>(grid.sectors()));
  for (int column = 0; column < kShape.columns; ++column) {
    ++columns[static_cast<std::size_t>(grid.sector_of(column))];
  }
  for (const int count : columns) {
    EXPECT_GE(count, 9);
    EXPECT_LE(count, 10);
  }
}

TEST(RingGrid, TheColumnsOfASectorAreThoseThatNameIt) {
  memory::FixedMemory memory;
  const RingGrid grid(kAsPrinted, test::even_profile(), kShape, memory);
  int next = 0;
  for (int sector = 0; sector < grid.sectors(); ++sector) {
    const auto [begin, end] = grid.columns_of({sector, sector + 1});
    EXPECT_EQ(begin, next);
    for (int column = begin; column < end; ++column) EXPECT_EQ(grid.sector_of(column), sector);
    next = end;
  }
  EXPECT_EQ(next, kShape.columns);
  const frame::ColumnRange all = grid.columns_of({0, grid.sectors()});
  EXPECT_EQ(all.begin, 0);
  EXPECT_EQ(all.end, kShape.columns);
}

TEST(RingGrid, ManyRangesAtOnceAreInTheBandsTheyAreInOneByOne) {
  memory::FixedMemory memory;
  const RingGrid grid(kAsPrinted, test::even_profile(), kShape, memory);
  std::vector<float> range_m{0.0F, 99.99F, 100.0F, 1e30F, std::nanf("")};
  for (float range = 0.3F; range < 120; range += 0.37F) range_m.push_back(range);
  std::vector<std::uint16_t> steps(range_m.size());
  grid.find_steps(range_m, steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(grid.band_of_step(steps[i]), grid.band_of(range_m[i])) << range_m[i];
  }
}

TEST(RingGrid, SurvivesAProfileWhoseBeamsNeverReachTheGround) {
  memory::FixedMemory memory;
  const RingGrid grid(kAsPrinted, test::even_profile(64, 1.0, 10.0), kShape, memory);
  EXPECT_GE(grid.bands(), 1);
  EXPECT_EQ(grid.band_of(50.0F), grid.bands() - 1);
}

}  // namespace
}  // namespace terracut::elevation
