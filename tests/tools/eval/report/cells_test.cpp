// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// How returns are spread over cells, against counts that follow from geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/eval/report/cell_grid.hpp"
#include "tools/eval/report/cell_tally.hpp"

namespace terracut::evaluation::report {
namespace {

using Kind = CellTally::Kind;

/// Lasers that meet the ground at the distances given.
calib::RingProfile profile_of(const std::vector<double>& distances_m) {
  calib::RingProfile profile;
  for (const double distance_m : distances_m) profile.rings.push_back({0, 0, distance_m});
  return profile;
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
  const pipeline::ImageShape shape{.rows = 64, .columns = 2000};
  std::vector<CellTally::Sample> world;
  for (const GroundPlace& place : flat_world(profile, shape))
    world.push_back({place, Kind::kGround});

  CellTally rings, squares;
  rings.add(RingCells({.columns_per_sector = 10}, profile, shape), world);
  squares.add(SquareGrid(1, 80), world);
  EXPECT_EQ(rings.all().empty, 0U);
  EXPECT_DOUBLE_EQ(rings.all().mean_points(), 10);
  EXPECT_DOUBLE_EQ(rings.all().variation(), 0);
  EXPECT_EQ(rings.histogram()[point_bin(10)], rings.all().cells);
  EXPECT_GT(squares.all().empty_share(), 0.8);
  EXPECT_GT(squares.all().variation(), 3);
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
  EXPECT_EQ(tally.annulus(0).no_ground_share(), 0);
  EXPECT_EQ(tally.annulus(1).points, 2);
  EXPECT_EQ(tally.annulus(1).no_ground_share(), 1);
  EXPECT_EQ(tally.all().obstacles, 2U);
  EXPECT_EQ(tally.all().no_ground_share(), 0.5);
  EXPECT_EQ(tally.all().cells - tally.all().empty, 2U);
}

TEST(Cells, VaryAsTheirCountsDo) {
  CellSums sums;
  for (const double points : {0.0, 4.0})
    sums += {1, points == 0 ? 1U : 0U, points, points * points, 0, 0};
  EXPECT_DOUBLE_EQ(sums.mean_points(), 2);
  EXPECT_DOUBLE_EQ(sums.variation(), 1);
  EXPECT_DOUBLE_EQ(sums.empty_share(), 0.5);
  EXPECT_EQ(CellSums{}.variation(), 0);
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
}  // namespace terracut::evaluation::report
