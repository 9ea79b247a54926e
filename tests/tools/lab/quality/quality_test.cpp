// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/quality/quality.hpp"

#include <gtest/gtest.h>

#include <array>

namespace terracut::quality {
namespace {

TEST(Quality, SortsSemanticKittiClasses) {
  for (const std::uint32_t id : {40U, 44U, 48U, 49U, 60U, 72U})
    EXPECT_EQ(truth_class(id), TruthClass::kGround) << id;
  for (const std::uint32_t id : {10U, 11U, 13U, 15U, 16U, 18U, 20U, 30U, 31U, 32U, 252U, 259U}) {
    EXPECT_EQ(truth_class(id), TruthClass::kKeyObstacle) << id;
  }
  for (const std::uint32_t id : {50U, 51U, 52U, 70U, 71U, 80U, 81U, 99U}) {
    EXPECT_EQ(truth_class(id), TruthClass::kOrdinaryObstacle) << id;
  }
  EXPECT_EQ(truth_class(0), TruthClass::kIgnored);
  EXPECT_EQ(truth_class(1), TruthClass::kIgnored);
  EXPECT_EQ(truth_class((7U << 16) | 40U), TruthClass::kGround) << "the instance is ignored";
}

TEST(Quality, MeasuresAreEquationsSixteenAndSeventeen) {
  using enum frame::Label;
  const std::array labels{kGround,   kGround, kGround,   kObstacle,
                          kObstacle, kGround, kObstacle, kGround};
  const std::array<std::uint32_t, 8> truth{40, 48, 72, 40, 10, 30, 50, 0};
  const Quality q = measure(labels, truth);
  // TP 3, FN 1 (the road called obstacle), FP 1 (the person); the unlabelled return counts nowhere.
  EXPECT_DOUBLE_EQ(q.iou_ground(), 3.0 / 5.0);
  EXPECT_DOUBLE_EQ(q.recall_key_obstacles(), 0.5);
  EXPECT_DOUBLE_EQ(q.precision_ground(), 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(q.recall_ground(), 3.0 / 4.0);
}

TEST(Quality, AddsUpOverFrames) {
  // One of each kind, and then all of them a second time.
  using enum frame::Label;
  const std::array labels{kGround, kObstacle, kGround, kObstacle, kGround, kObstacle, kObstacle};
  const std::array<std::uint32_t, 7> truth{40, 40, 10, 10, 50, 50, 30};
  const Quality once = measure(labels, truth);
  Quality sum = once;
  sum += once;
  EXPECT_EQ(sum.ground_as_ground, 2U);
  EXPECT_EQ(sum.ground_as_obstacle, 2U);
  EXPECT_EQ(sum.obstacle_as_ground, 4U);
  EXPECT_EQ(sum.obstacle_as_obstacle, 6U);
  EXPECT_EQ(sum.key_as_ground, 2U);
  EXPECT_EQ(sum.key_as_obstacle, 4U);
}

TEST(Quality, NothingToFindIsFoundWhole) {
  EXPECT_DOUBLE_EQ(Quality{}.iou_ground(), 1.0);
  EXPECT_DOUBLE_EQ(Quality{}.recall_key_obstacles(), 1.0);
}

}  // namespace
}  // namespace terracut::quality
