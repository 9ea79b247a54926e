// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/return_labels.hpp"

#include <gtest/gtest.h>

namespace terracut::stage {
namespace {

constexpr frame::ImageShape kShape{2, 16};
constexpr float kOwnerRange_m = 10.0F, kOwnerZ_m = -0.4F;

struct ReturnLabelsOfOneCell : testing::Test {
  /// The label of a second return, so far behind and above the owner of its cell, which stands
  /// `owner_height_m` above the ground and got `owner_label`.
  frame::Label second(float behind_m, float above_m, float owner_height_m,
                      frame::Label owner_label) {
    image.clear();
    constexpr int kRow = 1, kColumn = 3;
    EXPECT_TRUE(image.place(0, 0, {5, 0, 0, 5, 0}));
    EXPECT_TRUE(image.place(kRow, kColumn, {kOwnerRange_m, 0, kOwnerZ_m, kOwnerRange_m, 0}));
    const float range_m = kOwnerRange_m + behind_m;
    EXPECT_TRUE(image.place(kRow, kColumn, {range_m, 0, kOwnerZ_m + above_m, range_m, 0}));
    std::fill(planes.label.begin(), planes.label.end(), frame::Label::kNone);
    planes.label[kShape.cell(0, 0)] = frame::Label::kGround;
    planes.label[kShape.cell(kRow, kColumn)] = owner_label;
    planes.height_m[kShape.cell(kRow, kColumn)] = owner_height_m;
    labels.assign(image, planes);
    EXPECT_EQ(labels.labels().size(), 3U);
    EXPECT_EQ(labels.labels()[0], frame::Label::kGround);
    EXPECT_EQ(labels.labels()[1], owner_label) << "whatever lies behind it";
    return labels.labels()[2];
  }
  memory::FixedMemory memory;
  frame::RangeImage image{kShape, 4, memory};
  CellPlanes planes{kShape, memory};
  ReturnLabels labels{{.same_surface_range_m = 0.30F, .same_surface_height_m = 0.10F},
                      0.15F,
                      image.return_capacity(),
                      memory};
};

TEST_F(ReturnLabelsOfOneCell, OnItsOwnersSurfaceASecondReturnGetsItsOwnersLabel) {
  for (const float behind_m : {-0.29F, 0.0F, 0.29F}) {
    for (const float above_m : {-0.09F, 0.09F}) {
      EXPECT_EQ(second(behind_m, above_m, 0.05F, frame::Label::kObstacle), frame::Label::kObstacle);
      EXPECT_EQ(second(behind_m, above_m, 0.25F, frame::Label::kGround), frame::Label::kGround);
    }
  }
}

TEST_F(ReturnLabelsOfOneCell, AsFarAwayAsItsOwnerButHigherOrLowerItIsJudgedByItsOwnHeight) {
  EXPECT_EQ(second(0, 1.0F, 0, frame::Label::kGround), frame::Label::kObstacle)
      << "a branch above the road";
  EXPECT_EQ(second(0, 0.16F, 0, frame::Label::kGround), frame::Label::kObstacle);
  EXPECT_EQ(second(0, 0.11F, 0, frame::Label::kGround), frame::Label::kGround);
  EXPECT_EQ(second(0, -1.0F, 1.0F, frame::Label::kObstacle), frame::Label::kGround)
      << "the road below it";
}

TEST_F(ReturnLabelsOfOneCell, BehindOrBeforeItsOwnerItIsAnObstacleFromTheObstaclesHeightOn) {
  for (const float behind_m : {-5.0F, -0.31F, 0.31F, 5.0F}) {
    EXPECT_EQ(second(behind_m, 0.04F, 0.10F, frame::Label::kObstacle), frame::Label::kGround)
        << behind_m;
    EXPECT_EQ(second(behind_m, 0.06F, 0.10F, frame::Label::kGround), frame::Label::kObstacle)
        << behind_m;
    EXPECT_EQ(second(behind_m, 0.14F, 0, frame::Label::kObstacle), frame::Label::kGround)
        << behind_m;
    EXPECT_EQ(second(behind_m, 0.16F, 0, frame::Label::kGround), frame::Label::kObstacle)
        << behind_m;
  }
}

}  // namespace
}  // namespace terracut::stage
