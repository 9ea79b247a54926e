// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground_patches.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace terracut::pipeline {
namespace {

struct PatchesOfARow : testing::Test {
  static constexpr ImageShape kShape{2, 720};  // half a degree a column: two columns a patch

  PatchesOfARow() {
    for (int column = 0; column < kShape.columns; ++column) place(column, 0.0F, Label::kGround);
  }
  void place(int column, float z_m, Label label, float range_m = 20) {
    const auto cell = static_cast<std::size_t>(column);
    if (image.has_return(cell)) {
      image.clear();
      kept[cell] = {static_cast<float>(column), 1, z_m, range_m, 0};
      for (std::size_t i = 0; i < kept.size(); ++i) image.place(0, static_cast<int>(i), kept[i]);
    } else {
      kept.push_back({static_cast<float>(column), 1, z_m, range_m, 0});
      image.place(0, column, kept.back());
    }
    planes.height_m[cell] = z_m;
    planes.label[cell] = label;
  }
  const GroundPatches::Patch& patch(int index) {
    planes_of_empty_row();
    ground.collect(image, planes);
    return ground.patches()[static_cast<std::size_t>(index)];
  }
  void planes_of_empty_row() {
    for (auto cell = static_cast<std::size_t>(kShape.stride()); cell < kShape.cells(); ++cell) {
      planes.height_m[cell] = std::numeric_limits<float>::quiet_NaN();
    }
  }

  rt::FixedMemory memory;
  RangeImage image{kShape, 0, memory};
  CellPlanes planes{kShape, memory};
  GroundPatches ground{{}, kShape, memory};
  std::vector<Return> kept;
};

TEST_F(PatchesOfARow, HaveTheMeanPlaceOfTheirGroundReturns) {
  place(10, 0.2F, Label::kGround);
  place(12, 5.0F, Label::kObstacle);
  EXPECT_EQ(ground.per_row(), 360);
  EXPECT_FLOAT_EQ(patch(5).x_m, 10.5F);
  EXPECT_FLOAT_EQ(patch(5).z_m, 0.1F);
  EXPECT_FLOAT_EQ(patch(5).range_m, 20);
  EXPECT_FLOAT_EQ(patch(6).x_m, 13) << "the obstacle has no part in it";
}

TEST_F(PatchesOfARow, KnowObstaclesLowerThanTheVehicleOnly) {
  place(12, 1.0F, Label::kObstacle, 15);
  place(13, 1.2F, Label::kObstacle, 14);
  place(20, 3.0F, Label::kObstacle);
  EXPECT_TRUE(patch(6).has_obstacle);
  EXPECT_FALSE(patch(6).has_ground);
  EXPECT_FLOAT_EQ(patch(6).range_m, 14) << "of the nearest";
  EXPECT_FALSE(patch(10).has_obstacle);
  EXPECT_TRUE(patch(10).has_ground);
}

TEST_F(PatchesOfARow, AreAsRoughAsHeightsDepartFromTheMiddleOfTheirNeighbours) {
  EXPECT_FLOAT_EQ(patch(7).roughness_m, 0);
  for (int column = 0; column < kShape.columns; ++column) {
    place(column, column % 2 == 0 ? 0.01F : -0.01F, Label::kGround);
  }
  EXPECT_NEAR(patch(7).roughness_m, 0.02F, 1e-5F);
  EXPECT_NEAR(patch(0).roughness_m, 0.02F, 1e-3F) << "across the seam";
}

TEST_F(PatchesOfARow, AreNotRoughForLyingOnASlope) {
  for (int column = 0; column < kShape.columns; ++column) {
    place(column, 0.03F * static_cast<float>(column), Label::kGround);
  }
  EXPECT_NEAR(patch(100).roughness_m, 0, 1e-4F);
}

TEST_F(PatchesOfARow, OfARowWithoutReturnsAreEmpty) {
  EXPECT_FALSE(patch(ground.per_row() + 3).has_ground);
  EXPECT_FALSE(patch(ground.per_row() + 3).has_obstacle);
}

TEST_F(PatchesOfARow, GoOnBeyondBothEnds) {
  EXPECT_EQ(ground.wrapped(-1), 359);
  EXPECT_EQ(ground.wrapped(360), 0);
  EXPECT_EQ(ground.wrapped(-721), 359);
}

TEST_F(PatchesOfARow, AreCountedByLength) {
  EXPECT_EQ(ground.patches_over(1.0F, 20), 3);  // 0.35 m each
  EXPECT_EQ(ground.patches_over(0.01F, 20), 1);
  EXPECT_EQ(ground.patches_over(1.0F, 0), GroundPatches::kMostPatchesOver);
}

}  // namespace
}  // namespace terracut::pipeline
