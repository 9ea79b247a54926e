// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/ground_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace terracut::road {
namespace {

struct PatchesOfARow : testing::Test {
  static constexpr frame::ImageShape kShape{2, 720};  // half a degree a column: two columns a patch

  PatchesOfARow() {
    for (int column = 0; column < kShape.columns; ++column)
      place(column, 0.0F, frame::Label::kGround);
  }
  void place(int column, float z_m, frame::Label label, float range_m = 20) {
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
  struct Patch {
    float x_m, z_m, range_m, roughness_m;
    bool has_ground, has_obstacle;
  };
  Patch patch(int index) {
    planes_of_empty_row();
    ground.collect(image, planes);
    const auto i = static_cast<std::size_t>(index);
    return {ground.x_m()[i],
            ground.z_m()[i],
            ground.range_m()[i],
            ground.roughness_m()[i],
            ground.has_ground()[i] != 0,
            ground.has_obstacle()[i] != 0};
  }
  void planes_of_empty_row() {
    for (auto cell = static_cast<std::size_t>(kShape.stride()); cell < kShape.cells(); ++cell) {
      planes.height_m[cell] = std::numeric_limits<float>::quiet_NaN();
    }
  }

  memory::FixedMemory memory;
  frame::RangeImage image{kShape, 0, memory};
  stage::CellPlanes planes{kShape, memory};
  GroundPatches ground{{}, kShape, memory};
  std::vector<frame::Return> kept;
};

TEST_F(PatchesOfARow, LieBetweenTheirGroundReturnsAtTheirMeanHeight) {
  place(10, 0.2F, frame::Label::kGround);
  place(12, 5.0F, frame::Label::kObstacle);
  EXPECT_EQ(ground.per_row(), 360);
  EXPECT_FLOAT_EQ(patch(5).x_m, 10.5F);
  EXPECT_FLOAT_EQ(patch(5).z_m, 0.1F);
  EXPECT_FLOAT_EQ(patch(5).range_m, 20);
  EXPECT_FLOAT_EQ(patch(6).x_m, 13) << "the obstacle has no part in it";
}

/// The same with patches of more columns, and a shorter one at the row's end.
struct WidePatchesOfARow : PatchesOfARow {
  WidePatchesOfARow() {
    for (int column = 0; column < kShape.columns; ++column) {
      place(column, column % 2 == 0 ? 0.01F : -0.01F, frame::Label::kGround);
    }
  }
  /// Patches of so many columns, compared with what is said of the returns one by one.
  void expect_patches_of(int columns) {
    GroundPatches wide({.width_deg = 0.5F * static_cast<float>(columns)}, kShape, memory);
    ASSERT_EQ(wide.columns_per_patch(), columns);
    place(100, 5, frame::Label::kObstacle);
    place(101, 1, frame::Label::kObstacle, 7);
    for (int column = 200; column < 230; ++column) place(column, 1.5F, frame::Label::kObstacle, 9);
    planes_of_empty_row();
    wide.collect(image, planes);
    for (int index = 0; index < wide.per_row(); ++index) {
      const int begin = index * columns, end = std::min(begin + columns, kShape.columns);
      float sum_z = 0, nearest = 1e9F;
      int ground_returns = 0, first = -1, last = -1;
      bool has_obstacle = false;
      for (int column = begin; column < end; ++column) {
        const auto cell = static_cast<std::size_t>(column);
        if (planes.label[cell] == frame::Label::kGround) {
          sum_z += kept[cell].z_m;
          ++ground_returns;
          first = first < 0 ? column : first;
          last = column;
        } else if (kept[cell].z_m < 2) {
          has_obstacle = true;
          nearest = std::min(nearest, kept[cell].ground_range_m);
        }
      }
      const auto i = static_cast<std::size_t>(index);
      EXPECT_EQ(wide.has_ground()[i], ground_returns > 0) << index;
      EXPECT_EQ(wide.has_obstacle()[i], has_obstacle) << index;
      if (ground_returns > 0) {
        EXPECT_FLOAT_EQ(wide.x_m()[i], 0.5F * static_cast<float>(first + last)) << index;
        EXPECT_NEAR(wide.z_m()[i], sum_z / static_cast<float>(ground_returns), 1e-6F) << index;
        EXPECT_FLOAT_EQ(wide.range_m()[i], 20) << index;
        EXPECT_NEAR(wide.roughness_m()[i], 0.02F, 1e-3F) << index;
      } else if (has_obstacle) {
        EXPECT_FLOAT_EQ(wide.range_m()[i], nearest) << index;
      }
    }
  }
};

// Five and six columns have code of their own.
TEST_F(WidePatchesOfARow, OfFiveColumnsTellWhatTheirReturnsAre) {
  expect_patches_of(5);
}
TEST_F(WidePatchesOfARow, OfSixColumnsTellWhatTheirReturnsAre) {
  expect_patches_of(6);
}
TEST_F(WidePatchesOfARow, OfSevenColumnsTellWhatTheirReturnsAre) {
  expect_patches_of(7);
}

TEST_F(PatchesOfARow, KnowObstaclesLowerThanTheVehicleOnly) {
  place(12, 1.0F, frame::Label::kObstacle, 15);
  place(13, 1.2F, frame::Label::kObstacle, 14);
  place(20, 3.0F, frame::Label::kObstacle);
  EXPECT_TRUE(patch(6).has_obstacle);
  EXPECT_FALSE(patch(6).has_ground);
  EXPECT_FLOAT_EQ(patch(6).range_m, 14) << "of the nearest";
  EXPECT_FALSE(patch(10).has_obstacle);
  EXPECT_TRUE(patch(10).has_ground);
}

TEST_F(PatchesOfARow, AreAsRoughAsHeightsDepartFromTheMiddleOfTheirNeighbours) {
  EXPECT_FLOAT_EQ(patch(7).roughness_m, 0);
  for (int column = 0; column < kShape.columns; ++column) {
    place(column, column % 2 == 0 ? 0.01F : -0.01F, frame::Label::kGround);
  }
  EXPECT_NEAR(patch(7).roughness_m, 0.02F, 1e-5F);
  EXPECT_NEAR(patch(0).roughness_m, 0.02F, 1e-3F) << "across the seam";
}

TEST_F(PatchesOfARow, AreNotRoughForLyingOnASlope) {
  for (int column = 0; column < kShape.columns; ++column) {
    place(column, 0.03F * static_cast<float>(column), frame::Label::kGround);
  }
  EXPECT_NEAR(patch(100).roughness_m, 0, 1e-4F);
}

TEST_F(PatchesOfARow, OfARowWithoutReturnsAreEmpty) {
  EXPECT_FALSE(patch(ground.per_row() + 3).has_ground);
  EXPECT_FALSE(patch(ground.per_row() + 3).has_obstacle);
  EXPECT_TRUE(std::isnan(patch(ground.per_row() + 3).range_m));
}

/// A frame that was begun in the middle of the row, in which the ground rose by 10 cm.
struct SeamOfAFrame : testing::Test {
  static constexpr frame::ImageShape kShape{2, 720};
  static constexpr int kFirst = 300;  // column that arrived first

  SeamOfAFrame() {
    for (int n = 0; n < kShape.columns; ++n) {
      const int column = (kFirst + n) % kShape.columns;
      for (int row = 0; row < kShape.rows; ++row) {
        const auto cell = static_cast<std::size_t>(row * kShape.stride() + column);
        const float z_m = 0.1F * static_cast<float>(n) / static_cast<float>(kShape.columns);
        image.place(row, column, {static_cast<float>(column), 1, z_m, 20, 0});
        planes.height_m[cell] = 0;
        planes.label[cell] = frame::Label::kGround;
      }
    }
    ground.collect(image, planes);
  }

  memory::FixedMemory memory;
  frame::RangeImage image{kShape, 0, memory};
  stage::CellPlanes planes{kShape, memory};
  GroundPatches ground{{}, kShape, memory};
};

TEST_F(SeamOfAFrame, IsWhereTheLastReturnsMeetTheFirst) {
  const int before = (kFirst - 1) / ground.columns_per_patch();
  for (int row = 0; row < kShape.rows; ++row) {
    for (int index = 0; index < ground.per_row(); ++index) {
      const auto i = static_cast<std::size_t>(row * ground.per_row() + index);
      EXPECT_EQ(ground.is_seam()[i], index == before) << row << ", " << index;
    }
  }
}

TEST_F(SeamOfAFrame, IsNotRough) {
  for (const float roughness_m : ground.roughness_m()) EXPECT_LT(roughness_m, 0.005F);
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
}  // namespace terracut::road
