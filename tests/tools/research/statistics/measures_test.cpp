// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/statistics/measures.hpp"

#include <gtest/gtest.h>

#include "tools/research/datasets/built_in_tables.hpp"

namespace terracut::statistics {
namespace {

/// 80 of 100 road points, 30 of 60 of terrain, 4 of 10 of vegetation and 1 of 20 of cars are called
/// ground; 50 unlabelled ones, too. Road is near, the rest far.
FrameCounts counts() {
  FrameCounts counts;
  counts.add({40, 0}, {80, 20});
  counts.add({72, 2}, {30, 30});
  counts.add({70, 2}, {4, 6});
  counts.add({10, 2}, {1, 19});
  counts.add({0, 2}, {50, 0});
  counts.add({777, 2}, {9, 9});
  return counts;
}
datasets::ClassTable classes() {
  return *datasets::built_in_table("semantickitti");
}

TEST(MeasuresTest, CountAllPhysicalGround) {
  const auto quality = quality_of(counts(), classes(), {});
  EXPECT_DOUBLE_EQ(quality.iou_ground(), 110.0 / (110 + 50 + 5));
  EXPECT_DOUBLE_EQ(quality.recall_key_obstacles(), 19.0 / 20);
  EXPECT_DOUBLE_EQ(quality.precision_ground(), 110.0 / 115);
  EXPECT_DOUBLE_EQ(quality.recall_ground(), 110.0 / 160);
  const double p = 110.0 / 115, r = 110.0 / 160;
  EXPECT_DOUBLE_EQ(f1_ground(quality), 2 * p * r / (p + r));
}

TEST(MeasuresTest, CountTheRoadAloneAndUnlabelledPointsAgainstIt) {
  const auto quality =
      quality_of(counts(), classes(), {.ground = datasets::GroundDefinition::kRoad});
  EXPECT_DOUBLE_EQ(quality.iou_ground(), 80.0 / (80 + 20 + 30 + 4 + 1 + 50));
  EXPECT_DOUBLE_EQ(quality.recall_key_obstacles(), 19.0 / 20);
}

TEST(MeasuresTest, BelieveOfTheRoadWhatIsToldFromOtherGround) {
  FrameCounts told;
  told.add({40, 0}, {80, 20, 10});
  told.add({72, 2}, {30, 30, 25});
  told.add({10, 2}, {5, 15, 4});
  const auto road = quality_of(told, classes(), {.ground = datasets::GroundDefinition::kRoad});
  EXPECT_DOUBLE_EQ(road.iou_ground(), 70.0 / (70 + 30 + 5 + 1));
  EXPECT_DOUBLE_EQ(road.recall_key_obstacles(), 19.0 / 20);
  const auto all = quality_of(told, classes(), {});
  EXPECT_DOUBLE_EQ(all.iou_ground(), 110.0 / (110 + 50 + 5)) << "no matter here";
}

TEST(MeasuresTest, CountALabelledPointByItsLabel) {
  FrameCounts counts;
  for (const auto label : {frame::Label::kGround, frame::Label::kOtherGround,
                           frame::Label::kOtherGround, frame::Label::kObstacle}) {
    counts.add(48, 1, label);
  }
  EXPECT_EQ(counts.by_class_and_band().at({48, 1}), (LabelCounts{3, 1, 2}));
}

TEST(MeasuresTest, LeaveVegetationOut) {
  const auto quality = quality_of(counts(), classes(), {.vegetation = false});
  EXPECT_DOUBLE_EQ(quality.iou_ground(), 110.0 / (110 + 50 + 1));
}

TEST(MeasuresTest, LookAtOneRangeBand) {
  const auto near = quality_of(counts(), classes(), {.band = 0});
  EXPECT_DOUBLE_EQ(near.iou_ground(), 0.8);
  const auto middle = quality_of(counts(), classes(), {.band = 1});
  EXPECT_EQ(middle.ground_as_ground + middle.ground_as_obstacle, 0U);
}

TEST(MeasuresTest, KnowWhatCallingEverythingGroundScores) {
  const auto all = everything_ground(counts(), classes(), {});
  EXPECT_DOUBLE_EQ(all.iou_ground(), 160.0 / 190);
  EXPECT_DOUBLE_EQ(all.recall_key_obstacles(), 0);
}

TEST(MeasuresTest, KnowTheCeilingOfWhatDoesNotSeeKerbs) {
  EXPECT_DOUBLE_EQ(perfect_ground(counts(), classes(), {}).iou_ground(), 1);
  const auto road =
      perfect_ground(counts(), classes(), {.ground = datasets::GroundDefinition::kRoad});
  EXPECT_DOUBLE_EQ(road.iou_ground(), 100.0 / 160);
  EXPECT_DOUBLE_EQ(road.recall_key_obstacles(), 1);
}

TEST(RangeBandTest, BeginsAtItsNearEnd) {
  EXPECT_EQ(statistics::range_band(0), 0U);
  EXPECT_EQ(statistics::range_band(19.999), 0U);
  EXPECT_EQ(statistics::range_band(20), 1U);
  EXPECT_EQ(statistics::range_band(40), 2U);
  EXPECT_EQ(statistics::range_band(1e9), 2U);
}

}  // namespace
}  // namespace terracut::statistics
