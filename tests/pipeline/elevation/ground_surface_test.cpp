// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/ground_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/synthetic_frame.hpp"

namespace terracut::elevation {
namespace {

struct SurfaceOverGrid : testing::Test {
  SurfaceOverGrid()
      : grid(config(), test::even_profile(), {64, 2083}, memory), surface({}, 0.15F, grid, memory) {
    lowest.resize(grid.cells());
    fill([](float) { return 0.0F; });
  }
  static RingGrid::Config config() {
    RingGrid::Config c;
    c.min_band_m = 0.4F;
    c.max_band_m = 2.0F;
    return c;
  }
  /// Sets the lowest return of every cell from its range.
  template <class F>
  void fill(F height_of_range) {
    for (int s = 0; s < grid.sectors(); ++s)
      for (int b = 0; b < grid.bands(); ++b)
        lowest[grid.cell(s, b)] = {height_of_range(grid.center_m(b)), grid.center_m(b)};
  }
  void estimate() { estimate_from(0); }
  /// Each step goes around the circle from this sector on.
  void estimate_from(int first) {
    const int end = first + grid.sectors();
    for (int s = first; s < end; ++s) surface.trace(grid, s, lowest);
    for (int s = first; s < end; ++s) surface.find_donors(grid, s);
    for (int s = first; s < end; ++s) surface.estimate(grid, s, lowest);
  }
  /// Where it is lowest in a cell.
  float at(int sector, float range_m) { return edges(sector, range_m).lower_m(); }
  GroundSurface::EdgeHeights edges(int sector, float range_m) {
    return surface.heights()[grid.cell(sector, grid.band_of(range_m))];
  }
  /// Ground whose height depends on the sector.
  template <class F>
  void fill_sectors(F height_of_sector) {
    for (int s = 0; s < grid.sectors(); ++s) {
      for (int b = 0; b < grid.bands(); ++b) {
        lowest[grid.cell(s, b)] = {height_of_sector(s), grid.center_m(b), height_of_sector(s)};
      }
    }
  }
  memory::FixedMemory memory;
  RingGrid grid;
  GroundSurface surface;
  std::vector<GroundSurface::LowestReturn> lowest;
};

TEST_F(SurfaceOverGrid, FollowsAFifteenPercentSlopeThatBeginsNearOrFar) {
  for (const float foot_m : {6.0F, 30.0F}) {
    const auto hill = [foot_m](float range_m) { return 0.15F * std::max(0.0F, range_m - foot_m); };
    fill(hill);
    estimate();
    for (float range_m : {6.0F, 15.0F, 40.0F, 80.0F}) {
      EXPECT_NEAR(at(3, range_m), hill(grid.center_m(grid.band_of(range_m))), 0.05F) << range_m;
    }
  }
}

TEST_F(SurfaceOverGrid, PutsTheLowestReturnWhereItIsNotIntoTheMiddleOfItsCell) {
  // A bank of 40 %: its lowest return is at the near end of each cell.
  const auto bank = [](float range_m) { return 0.4F * std::max(0.0F, range_m - 10.0F); };
  for (int s = 0; s < grid.sectors(); ++s) {
    float near_m = 0;
    for (int b = 0; b < grid.bands(); ++b) {
      lowest[grid.cell(s, b)] = {bank(near_m), near_m};
      near_m = 2 * grid.center_m(b) - near_m;  // where the next band begins
    }
  }
  estimate();
  for (float range_m : {6.0F, 15.0F, 25.0F, 40.0F}) {
    EXPECT_NEAR(at(3, range_m), bank(grid.center_m(grid.band_of(range_m))), 0.1F) << range_m;
  }
}

TEST_F(SurfaceOverGrid, FollowsASensorPitchedByFiveDegrees) {
  for (const float slope : {0.087F, -0.087F}) {
    fill([slope](float range_m) { return slope * range_m; });
    estimate();
    for (float range_m : {6.0F, 15.0F, 40.0F, 80.0F}) {
      EXPECT_NEAR(at(3, range_m), slope * grid.center_m(grid.band_of(range_m)), 0.05F) << range_m;
    }
  }
}

TEST_F(SurfaceOverGrid, DoesNotClimbOntoAWall) {
  fill([](float range_m) { return range_m < 12 ? 0.0F : 1.5F; });
  estimate();
  EXPECT_NEAR(at(0, 13.0F), 0.0F, 0.01F);
  EXPECT_NEAR(at(0, 30.0F), 0.0F, 0.01F);
}

TEST_F(SurfaceOverGrid, DoesNotBeginOnTheFlankOfACarBesideTheSensor) {
  // All that its sectors see: a car 3 m away, sill to roof, and a house behind it.
  const auto car = [](float range_m) { return range_m < 5 ? 0.45F : 0.45F + 0.3F * (range_m - 5); };
  for (int s = 20; s < 30; ++s) {
    for (int b = 0; b < grid.bands(); ++b) {
      lowest[grid.cell(s, b)].height_m = car(grid.center_m(b));
    }
  }
  estimate();
  EXPECT_NEAR(at(25, 4.0F), 0.0F, 0.05F);
  EXPECT_NEAR(at(25, 8.0F), 0.0F, 0.05F);
}

TEST_F(SurfaceOverGrid, AStepUpToTheFootOfSomethingTallIsNoGround) {
  for (const bool is_tall : {false, true}) {
    fill([](float range_m) { return range_m < 12 ? 0.0F : 0.25F; });
    if (is_tall) {
      for (auto& cell : lowest)
        cell.highest_m = cell.range_m > 12 && cell.range_m < 14 ? 2.0F : 0.0F;
    }
    estimate();
    EXPECT_NEAR(at(0, 13.0F), is_tall ? 0.0F : 0.25F, 0.02F) << is_tall;
  }
}

TEST_F(SurfaceOverGrid, FindsTheGroundAgainBehindAHiddenStretch) {
  fill([](float range_m) { return range_m > 10 && range_m < 16 ? GroundSurface::kEmpty : 0.05F; });
  estimate();
  EXPECT_NEAR(at(0, 20.0F), 0.05F, 0.001F);
  EXPECT_NEAR(at(0, 13.0F), 0.05F, 0.06F);
}

TEST_F(SurfaceOverGrid, FindsABankBehindADitchThatHidesItsFoot) {
  const auto bank = [](float range_m) { return 0.6F + 0.3F * (range_m - 16.0F); };
  fill([&](float range_m) {
    return range_m < 10 ? 0.0F : range_m < 16 ? GroundSurface::kEmpty : bank(range_m);
  });
  estimate();
  EXPECT_NEAR(at(5, 25.0F), bank(grid.center_m(grid.band_of(25.0F))), 0.1F);
}

TEST_F(SurfaceOverGrid, FindsABankBehindAParkedCarThatHidesItsFoot) {
  // Of the car, its flank and its roof. A passable way leads from the roof to the bank.
  const auto bank = [](float range_m) { return 1.0F + 0.35F * (range_m - 13.0F); };
  fill([&](float range_m) {
    if (range_m < 6) return 0.0F;
    if (range_m < 8) return range_m < 6.8F ? 0.6F : 1.5F;
    return range_m < 13 ? GroundSurface::kEmpty : bank(range_m);
  });
  estimate();
  EXPECT_NEAR(at(5, 20.0F), bank(grid.center_m(grid.band_of(20.0F))), 0.1F);
  EXPECT_NEAR(at(5, 7.5F), 0.0F, 0.1F) << "the roof is none";
}

TEST_F(SurfaceOverGrid, FindsABankBesideTheWayThoughLowerGroundShowsFarBehindIt) {
  // The bank begins with a step that is too high; far behind it lies ground that may be stepped
  // down to.
  const auto bank = [](float range_m) { return 0.5F + 0.3F * (range_m - 10.0F); };
  fill([&](float range_m) {
    return range_m < 9 ? 0.0F : range_m < 18 ? bank(range_m) : range_m < 60 ? 9.0F : -0.2F;
  });
  estimate();
  EXPECT_NEAR(at(5, 14.0F), bank(grid.center_m(grid.band_of(14.0F))), 0.1F);
}

TEST_F(SurfaceOverGrid, RisesAcrossASectorWhereTheGroundRisesFromSectorToSector) {
  constexpr float kRise_m = 0.03F;  // a sector
  const int first = 40, last = 50;
  for (const float sign : {1.0F, -1.0F}) {
    fill_sectors([&](int s) {
      return sign * kRise_m * static_cast<float>(std::clamp(s, first, last) - first);
    });
    estimate();
    const auto [first_m, last_m] = edges(45, 20.0F);
    EXPECT_NEAR(last_m - first_m, sign * kRise_m, 1e-4F);
    EXPECT_NEAR(std::min(first_m, last_m), sign * kRise_m * 5, 1e-4F);
    EXPECT_EQ(edges(first, 20.0F).first_m, edges(first, 20.0F).last_m) << "where it begins";
    EXPECT_EQ(edges(last, 20.0F).first_m, edges(last, 20.0F).last_m) << "where it ends";
  }
}

TEST_F(SurfaceOverGrid, RisesAcrossNoSectorMoreThanGroundMay) {
  fill_sectors([](int s) { return 0.15F * static_cast<float>(std::clamp(s, 40, 44) - 42); });
  estimate();
  const float sector_m =
      2 * 3.14159265F / static_cast<float>(grid.sectors()) * grid.center_m(grid.band_of(8.0F));
  const auto [first_m, last_m] = edges(42, 8.0F);
  EXPECT_NEAR(last_m - first_m, GroundSurface::Config{}.max_slope * sector_m, 1e-4F);
}

TEST_F(SurfaceOverGrid, RisesAcrossNoSectorBesideAKerb) {
  fill_sectors([](int s) { return s < 40 ? 0.0F : 0.12F; });
  estimate();
  for (const int sector : {39, 40}) {
    EXPECT_EQ(edges(sector, 20.0F).first_m, edges(sector, 20.0F).last_m) << sector;
  }
}

TEST_F(SurfaceOverGrid, RisesAcrossNoSectorWhereSomethingTallStandsInItOrBesideIt) {
  for (const int tall : {44, 45, 46}) {
    fill_sectors([](int s) { return 0.03F * static_cast<float>(std::clamp(s, 40, 50) - 40); });
    lowest[grid.cell(tall, grid.band_of(20.0F))].highest_m = 2.0F;
    estimate();
    EXPECT_EQ(edges(45, 20.0F).first_m, edges(45, 20.0F).last_m) << tall;
    EXPECT_NE(edges(45, 30.0F).first_m, edges(45, 30.0F).last_m) << tall;
  }
}

TEST_F(SurfaceOverGrid, DoesNotTakeARoofForGroundWhenGroundShowsAgainBehindIt) {
  fill([](float range_m) { return range_m > 12 && range_m < 20 ? 1.5F : 0.0F; });
  estimate();
  EXPECT_NEAR(at(5, 16.0F), 0.0F, 0.01F);
}

TEST_F(SurfaceOverGrid, DoesNotTakeARowOfRoofsForGroundThoughNothingShowsBehindIt) {
  fill([](float) { return 0.0F; });
  for (int band = grid.band_of(12.0F); band < grid.bands(); ++band) {
    for (const int sector : {7, 8, 9})
      lowest[grid.cell(sector, band)].height_m = 1.5F;  // 1.1 m wide at 12 m
  }
  estimate();
  EXPECT_NEAR(at(8, 16.0F), 0.0F, 0.1F);
}

TEST_F(SurfaceOverGrid, IgnoresAReflectionFarBelowTheGround) {
  fill([](float) { return 0.0F; });
  const int band = grid.band_of(15.0F);
  lowest[grid.cell(7, band)].height_m = -4.0F;
  estimate();
  EXPECT_NEAR(at(7, 15.0F), 0.0F, 0.01F);
}

TEST_F(SurfaceOverGrid, ACellWithoutGroundIsInterpolatedAcrossTheSeam) {
  // Ground that rises slowly with range, hidden behind a wall in the sectors around the seam.
  fill([](float range_m) { return 0.03F * range_m; });
  for (int band = grid.band_of(8.0F); band < grid.bands(); ++band) {
    lowest[grid.cell(0, band)].height_m = 9.0F;
    lowest[grid.cell(grid.sectors() - 1, band)].height_m = 9.0F;
  }
  estimate();
  const float true_m = 0.03F * grid.center_m(grid.band_of(40.0F));
  EXPECT_NEAR(at(0, 40.0F), true_m, 0.25F);
  EXPECT_NEAR(at(grid.sectors() - 1, 40.0F), true_m, 0.25F);
}

TEST_F(SurfaceOverGrid, InterpolatesAcrossTheSeamFromOneSideAlone) {
  // Hidden sectors from the seam on, more of them than ground is interpolated over.
  constexpr int kHidden = 30;
  const float true_m = 0.03F * grid.center_m(grid.band_of(40.0F));
  for (const bool is_right : {false, true}) {
    fill([](float range_m) { return 0.03F * range_m; });
    for (int n = 0; n < kHidden; ++n) {
      const int sector = is_right ? n : grid.sectors() - 1 - n;
      for (int band = grid.band_of(8.0F); band < grid.bands(); ++band) {
        lowest[grid.cell(sector, band)].height_m = 9.0F;
      }
    }
    estimate();
    EXPECT_NEAR(at(is_right ? 0 : grid.sectors() - 1, 40.0F), true_m, 0.25F) << is_right;
  }
}

TEST_F(SurfaceOverGrid, IsTheSameWhereverTheCircleIsBegun) {
  // Behind a ditch there is ground on a strip across the seam only.
  fill([](float range_m) {
    return range_m < 10 ? 0.0F : range_m < 16 ? GroundSurface::kEmpty : 9;
  });
  for (int n = -12; n < 8; ++n) {
    for (int band = grid.band_of(16.5F); band < grid.bands(); ++band) {
      lowest[grid.cell(grid.wrapped(n), band)].height_m = 0.8F;
    }
  }
  estimate();
  const std::vector<GroundSurface::EdgeHeights> expected(surface.heights().begin(),
                                                         surface.heights().end());
  EXPECT_GT(at(1, 20.0F), 0.7F);
  for (const int first : {1, 20, 203}) {
    GroundSurface fresh({}, 0.15F, grid, memory);
    std::swap(surface, fresh);
    estimate_from(first);
    EXPECT_TRUE(std::ranges::equal(surface.heights(), expected)) << first;
  }
}

TEST_F(SurfaceOverGrid, InterpolatesFromFiveSectorsAheadAndNoMore) {
  // Ground of all sectors, hidden in one; what lies beyond what is waited for is not looked at.
  fill([](float range_m) { return 0.03F * range_m; });
  constexpr int kHere = 50;
  const int band = grid.band_of(40.0F);
  for (int b = grid.band_of(8.0F); b < grid.bands(); ++b) {
    for (int s = kHere - 30; s <= kHere; ++s) lowest[grid.cell(s, b)].height_m = 9.0F;
  }
  const float true_m = 0.03F * grid.center_m(band);
  for (const int ahead : {5, 6}) {
    for (int b = grid.band_of(8.0F); b < grid.bands(); ++b) {
      for (int s = kHere; s < kHere + ahead; ++s) lowest[grid.cell(s, b)].height_m = 9.0F;
    }
    estimate();
    EXPECT_EQ(std::fabs(at(kHere, 40.0F) - true_m) < 0.01F, ahead == 5) << ahead;
  }
}

TEST_F(SurfaceOverGrid, FollowsGroundThatFallsAwayFasterThanItMayRise) {
  // Over 3 m: too short for ground to be found again behind where it was lost.
  for (const float slope : {-0.38F, 0.38F}) {
    const auto edge = [slope](float range_m) { return slope * std::max(0.0F, range_m - 10.0F); };
    fill([&](float range_m) { return range_m < 13 ? edge(range_m) : GroundSurface::kEmpty; });
    estimate();
    const float middle_m = grid.center_m(grid.band_of(12.0F));
    EXPECT_EQ(std::fabs(at(5, 12.0F) - edge(middle_m)) < 0.1F, slope < 0) << at(5, 12.0F);
  }
}

}  // namespace
}  // namespace terracut::elevation
