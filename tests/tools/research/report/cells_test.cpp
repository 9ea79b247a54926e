// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// How returns are spread over cells, against counts that follow from geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/research/report/cell_grid.hpp"
#include "tools/research/report/cell_tally.hpp"

namespace terracut::report {
namespace {

using Kind = CellTally::Kind;

/// Lasers that meet the ground at the distances given.
mount::RingProfile profile_of(const std::vector<double>& distances_m) {
  mount::RingProfile profile;
  for (const double distance_m : distances_m) profile.rings.push_back({0, 0, distance_m});
  return profile;
}

CellSums all_of(const CellTally& tally) {
  CellSums sum;
  for (std::size_t i = 0; i < kAnnuli.size(); ++i) sum += tally.annulus(i);
  return sum;
}

GroundPlace at(float x_m, float y_m, int column = 0) {
  return {x_m, y_m, std::hypot(x_m, y_m), column};
}

TEST(Cells, SquaresHaveTheirMiddlesAndTheirEdges) {
  const SquareGrid grid(2, 10);
  EXPECT_EQ(grid.centre_range_m().size(), 100U);
  const auto cell = grid.cell_of(at(7.5F, -0.5F));
  ASSERT_TRUE(cell);
  EXPECT_FLOAT_EQ(grid.centre_range_m()[*cell], std::hypot(7.0F, 1.0F));
  EXPECT_EQ(grid.cell_of(at(6.01F, -1.99F)), cell);
  EXPECT_NE(grid.cell_of(at(6.01F, 0.01F)), cell);
  EXPECT_FALSE(grid.cell_of(at(10.01F, 0)));
  EXPECT_FALSE(grid.cell_of(at(0, -10.01F)));
  EXPECT_FALSE(grid.cell_of(at(std::nanf(""), 0)));
}

TEST(Cells, SquaresOfAFlatWorldHaveTheReturnsOfEquationTwo) {
  constexpr int kColumns = 3600;
  const auto world = flat_world(profile_of({9.9}), {.rows = 64, .columns = kColumns});
  ASSERT_EQ(world.size(), static_cast<std::size_t>(kColumns));
  const SquareGrid grid(1, 20);
  const auto square = grid.cell_of(at(9.5F, 0.5F));  // x in [9, 10), y in [0, 1)
  const auto count = std::ranges::count_if(
      world, [&](const auto& place) { return grid.cell_of(place) == square; });
  // The circle of 9.9 m passes this square from y = 0 to y = 1.
  const double share = std::asin(1 / 9.9) / (2 * std::numbers::pi);
  EXPECT_NEAR(static_cast<double>(count), kColumns * share, 1.0);
}

TEST(Cells, RingsOfAFlatWorldAllHaveTheSameReturnsAndSquaresDoNot) {
  const auto profile = profile_of({6, 8, 11, 15, 22, 35, 60});
  const frame::ImageShape shape{.rows = 64, .columns = 2000};
  std::vector<CellTally::Sample> world;
  for (const GroundPlace& place : flat_world(profile, shape))
    world.push_back({place, Kind::kGround});

  CellTally rings, squares;
  rings.add(
      RingCells({.min_band_m = 0, .max_band_m = 1e9F, .columns_per_sector = 10}, profile, shape),
      world);
  squares.add(SquareGrid(1, 80), world);
  const CellSums of_rings = all_of(rings), of_squares = all_of(squares);
  EXPECT_EQ(of_rings.empty, 0U);
  EXPECT_EQ(of_rings.points, 10.0 * static_cast<double>(of_rings.cells));
  EXPECT_EQ(of_rings.points_squared, 100.0 * static_cast<double>(of_rings.cells));
  EXPECT_EQ(rings.histogram()[point_bin(10)], of_rings.cells);
  EXPECT_GT(of_squares.empty * 10, of_squares.cells * 8);
}

TEST(Cells, AreToldApartByDistanceAndLeftOutBeyondAllAnnuli) {
  const SquareGrid grid(2, 100);
  CellTally tally;
  tally.add(grid, {{at(7, 0), Kind::kGround},
                   {at(7, 0), Kind::kObstacle},
                   {at(15, 0), Kind::kObstacle},
                   {at(15, 0), Kind::kNeither},
                   {at(1, 0), Kind::kObstacle},
                   {at(95, 0), Kind::kObstacle}});
  EXPECT_EQ(tally.annulus(0).points, 2);
  EXPECT_EQ(tally.annulus(0).points_squared, 4);
  EXPECT_EQ(tally.annulus(0).obstacles, 1U);
  EXPECT_EQ(tally.annulus(0).obstacles_on_no_ground, 0U);
  EXPECT_EQ(tally.annulus(1).points, 2);
  EXPECT_EQ(tally.annulus(1).obstacles_on_no_ground, 1U);
  const CellSums all = all_of(tally);
  EXPECT_EQ(all.obstacles, 2U);
  EXPECT_EQ(all.cells - all.empty, 2U);
}

TEST(Cells, FallIntoOctaves) {
  EXPECT_EQ(kPointBinNames[point_bin(0)], "0");
  EXPECT_EQ(kPointBinNames[point_bin(1)], "1");
  EXPECT_EQ(kPointBinNames[point_bin(3)], "2–3");
  EXPECT_EQ(kPointBinNames[point_bin(4)], "4–7");
  EXPECT_EQ(kPointBinNames[point_bin(255)], "128–255");
  EXPECT_EQ(kPointBinNames[point_bin(4'000'000'000)], "≥256");
}

}  // namespace
}  // namespace terracut::report
