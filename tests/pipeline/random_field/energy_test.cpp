// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/random_field/boundary_term.hpp"
#include "pipeline/random_field/region_term.hpp"

namespace terracut::random_field {
namespace {

const frame::ImageShape kShape{4, 16};

struct FourCells : testing::Test {
  FourCells() : image(kShape, 0, memory), planes(kShape, memory) {}
  void put(int row, int column, float x, float z, min_cut::Seed seed, float height) {
    image.place(row, column, {x, 0, z, std::fabs(x), 0});
    const auto cell = static_cast<std::size_t>(row * kShape.stride() + column);
    seeds[cell] = seed;
    planes.height_m[cell] = height;
  }
  memory::FixedMemory memory;
  frame::RangeImage image;
  stage::CellPlanes planes;
  std::vector<min_cut::Seed> seeds =
      std::vector<min_cut::Seed>(kShape.cells(), min_cut::Seed::kNone);
};

TEST_F(FourCells, RampCostsNothingAtTheEvenHeightAndLambdaBeyondTheRamp) {
  RegionTerm::Config config;
  config.lambda = 2.0F;
  config.even_height_m = 0.1F;
  config.ramp_m = 0.2F;
  RegionTerm region(config);
  put(0, 0, 5, 0, min_cut::Seed::kUnknown, 0.1F);
  put(0, 1, 5, 0, min_cut::Seed::kUnknown, 0.2F);
  put(0, 2, 5, 0, min_cut::Seed::kUnknown, 5.0F);
  put(0, 3, 5, 0, min_cut::Seed::kUnknown, -5.0F);
  region.look_at(image.points(), planes, seeds);
  EXPECT_EQ(region(0).ground, 0);
  EXPECT_EQ(region(0).obstacle, 0);
  EXPECT_NEAR(region(1).ground, min_cut::kCapacityScale, 1) << "half way up: lambda / 2";
  EXPECT_EQ(region(2).ground, 2 * min_cut::kCapacityScale);
  EXPECT_EQ(region(2).obstacle, 0);
  EXPECT_EQ(region(3).obstacle, 2 * min_cut::kCapacityScale);
}

TEST_F(FourCells, HistogramCostIsTheNegativeLogOfTheSeedsShareAtThatHeight) {
  RegionTerm::Config config;
  config.rule = RegionRule::kHistogram;
  config.lambda = 1.0F;
  config.bins_per_metre = 10.0F;
  RegionTerm region(config);
  for (int i = 0; i < 3; ++i) put(0, i, 5, 0.0F, min_cut::Seed::kGround, 0);
  put(0, 3, 5, 1.0F, min_cut::Seed::kObstacle, 1);
  put(1, 0, 5, 0.0F, min_cut::Seed::kUnknown, 0);
  put(1, 1, 5, 1.0F, min_cut::Seed::kUnknown, 1);
  region.look_at(image.points(), planes, seeds);
  const auto stride = static_cast<std::uint32_t>(kShape.stride());
  const auto cost = [](double count, double total) {
    return min_cut::kCapacityScale * -std::log((count + 1) / (total + RegionTerm::kMaxBins));
  };
  EXPECT_NEAR(region(stride).ground, cost(3, 3), 1);
  EXPECT_NEAR(region(stride).obstacle, cost(0, 1), 1);
  EXPECT_NEAR(region(stride + 1).ground, cost(0, 3), 1);
  EXPECT_NEAR(region(stride + 1).obstacle, cost(1, 1), 1);
}

TEST_F(FourCells, HistogramBinsLieAroundWholeTenthsAboveTheLowestGroundSeed) {
  RegionTerm::Config config;
  config.rule = RegionRule::kHistogram;
  config.bins_per_metre = 10.0F;
  RegionTerm region(config);
  put(0, 0, 5, -0.3F, min_cut::Seed::kGround, 0);
  put(0, 1, 5, -0.26F, min_cut::Seed::kUnknown, 0);  // 4 cm above it
  put(0, 2, 5, -0.24F, min_cut::Seed::kUnknown, 0);  // 6 cm
  put(0, 3, 5, -0.34F, min_cut::Seed::kUnknown, 0);  // 4 cm below
  region.look_at(image.points(), planes, seeds);
  EXPECT_LT(region(1).ground, region(2).ground);
  EXPECT_EQ(region(1).ground, region(3).ground);
}

TEST_F(FourCells, HistogramWithoutAnySeedIsFiniteAndFair) {
  RegionTerm::Config config;
  config.rule = RegionRule::kHistogram;
  RegionTerm region(config);
  put(0, 0, 5, -300.0F, min_cut::Seed::kUnknown, 0);
  region.look_at(image.points(), planes, seeds);
  EXPECT_EQ(region(0).ground, region(0).obstacle);
}

/// The weight of the edge between two cells, [0, 1], in whole steps.
double weight(const BoundaryTerm& boundary, std::size_t p, std::size_t q) {
  min_cut::NeighbourCells all_of_them{};
  all_of_them.fill(static_cast<std::uint32_t>(q));
  std::array<std::uint16_t, min_cut::kDirections> weights{};
  boundary(static_cast<std::uint32_t>(p), all_of_them, weights);
  return static_cast<double>(weights[0]) / min_cut::kCapacityScale;
}
constexpr double kStep = 1.0 / min_cut::kCapacityScale;

TEST_F(FourCells, HeightGradientWeightIsEquationFourteen) {
  BoundaryTerm::Config config;
  config.rule = BoundaryRule::kHeightGradient;
  config.sigma = 10;
  put(0, 0, 5.0F, 0.0F, min_cut::Seed::kUnknown, 0);
  put(0, 1, 5.5F, 0.2F, min_cut::Seed::kUnknown, 0);
  const stage::NegativeExp negative_exp;
  const BoundaryTerm boundary(config, negative_exp, image.points());
  EXPECT_NEAR(weight(boundary, 0, 1), std::exp(-10 * 0.04 / 0.5), kStep);
}

TEST_F(FourCells, NearnessWeightFallsWithDistanceOverAScaleThatGrowsWithTheMeanRange) {
  BoundaryTerm::Config config;
  config.rule = BoundaryRule::kNearness;
  config.scale_m = 0.2F;
  config.scale_per_metre = 0.01F;
  put(0, 0, 5.0F, 0.0F, min_cut::Seed::kUnknown, 0);
  put(0, 1, 5.3F, 0.4F, min_cut::Seed::kUnknown, 0);   // 0.5 m away, along and up
  put(0, 2, 55.0F, 0.0F, min_cut::Seed::kUnknown, 0);  // 50 m away
  const stage::NegativeExp negative_exp;
  const BoundaryTerm boundary(config, negative_exp, image.points());
  EXPECT_NEAR(weight(boundary, 0, 1), std::exp(-0.5 / (0.2 + 0.01 * 5.15)), kStep);
  EXPECT_EQ(weight(boundary, 0, 2), 0.0);
  config.scale_m = 50;
  EXPECT_NEAR(weight(BoundaryTerm(config, negative_exp, image.points()), 0, 2),
              std::exp(-50 / (50 + 0.01 * 30)), kStep);
}

TEST_F(FourCells, EdgesToAllNeighboursGetTheirWeightInWholeNumbers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> metres(0, 1);
  for (int row = 0; row < kShape.rows; ++row) {
    for (int column = 0; column < kShape.columns; ++column) {
      const float x_m = 5 + metres(random), y_m = metres(random);
      image.place(row, column, {x_m, y_m, metres(random), std::hypot(x_m, y_m), 0});
    }
  }
  const stage::NegativeExp negative_exp;
  for (const BoundaryRule rule : {BoundaryRule::kHeightGradient, BoundaryRule::kNearness}) {
    BoundaryTerm::Config config;
    config.rule = rule;
    config.sigma = 0.5F;  // no weight is 0
    config.scale_m = 1;
    const BoundaryTerm boundary(config, negative_exp, image.points());
    for (const int column : {0, 7, kShape.columns - 1}) {
      const auto cell = static_cast<std::uint32_t>(kShape.cell(1, column));
      const min_cut::NeighbourCells around = min_cut::neighbour_cells(kShape, 1, column);
      std::array<std::uint16_t, min_cut::kDirections> weights{};
      boundary(cell, around, std::span<std::uint16_t, min_cut::kDirections>(weights));
      for (std::size_t d = 0; d < around.size(); ++d) {
        EXPECT_NEAR(weights[d], weight(boundary, cell, around[d]) * min_cut::kCapacityScale, 1);
        EXPECT_GT(weights[d], 0);
      }
    }
  }
}

TEST_F(FourCells, WeightsAreTheSameBothWaysBitForBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> metres(-50, 50);
  for (int i = 0; i < 16; ++i) {
    image.place(0, i,
                {metres(random), metres(random), metres(random) / 20, metres(random) + 60, 0});
  }
  const stage::NegativeExp negative_exp;
  for (const BoundaryRule rule : {BoundaryRule::kHeightGradient, BoundaryRule::kNearness}) {
    BoundaryTerm::Config config;
    config.rule = rule;
    config.scale_m = 10;
    const BoundaryTerm boundary(config, negative_exp, image.points());
    for (std::size_t p = 0; p < 16; ++p) {
      for (std::size_t q = 0; q < 16; ++q) {
        EXPECT_EQ(weight(boundary, p, q), weight(boundary, q, p));
        EXPECT_GE(weight(boundary, p, q), 0.0);
        EXPECT_LE(weight(boundary, p, q), 1.0);
      }
    }
  }
}

}  // namespace
}  // namespace terracut::random_field
