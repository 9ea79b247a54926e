// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/statistics/true_ground.hpp"

#include <gtest/gtest.h>

#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/eval/frame_judge.hpp"

namespace terracut::statistics {
namespace {

constexpr std::uint32_t kRoad = 40, kTerrain = 72, kCar = 10, kBuilding = 50;

struct TrueGroundTest : testing::Test {
  datasets::ClassTable classes = *datasets::built_in_table("semantickitti");
  scan::KittiScan scan;

  void add(float x_m, float y_m, float z_m, std::uint32_t label) {
    scan.points.push_back({x_m, y_m, z_m, 0});
    scan.labels.push_back(label);
  }
};

TEST_F(TrueGroundTest, IsTheMeanOfWhatIsLabelledGround) {
  add(10.1F, 0.1F, -1.8F, kRoad);
  add(10.2F, 0.2F, -1.6F, kTerrain);
  add(10.2F, 0.2F, 3, kBuilding);
  TrueGround ground(classes);
  ground.look_at(scan);
  EXPECT_NEAR(ground.height_m(10.15, 0.15).value(), -1.7, 1e-6);
  EXPECT_NEAR(ground.height_m(11.5, 0.15).value(), -1.7, 1e-6);
  EXPECT_FALSE(ground.height_m(13, 0.15));
}

TEST_F(TrueGroundTest, NearerSquaresCountMore) {
  add(10.1F, 0.1F, 0, kRoad);
  add(11.6F, 0.1F, 1, kRoad);
  TrueGround ground(classes);
  ground.look_at(scan);
  EXPECT_LT(ground.height_m(10.1, 0.1).value(), 0.2);
  EXPECT_GT(ground.height_m(11.6, 0.1).value(), 0.8);
}

TEST_F(TrueGroundTest, KeyObstaclesCountAsTallFromThirtyCentimetresOn) {
  add(10.1F, 0.1F, -1.7F, kRoad);
  add(10.1F, 0.1F, -1.45F, kCar);      // its foot
  add(10.1F, 0.1F, -1.3F, kCar);       // tall, called ground
  add(10.1F, 0.1F, -1.0F, kCar);       // tall
  add(10.1F, 0.1F, -1.0F, kBuilding);  // no key obstacle
  add(40, 40, 0, kCar);                // nobody knows how tall
  eval::FrameJudge judge(classes, 1);
  judge.look_at(scan, std::nullopt);
  using frame::Label;
  eval::FrameResult result;
  judge.judge(0,
              std::vector{Label::kGround, Label::kGround, Label::kGround, Label::kObstacle,
                          Label::kGround, Label::kGround},
              result);
  EXPECT_EQ(result.tall, (TallCounts{.returns = 2, .as_ground = 1}));
}

}  // namespace
}  // namespace terracut::statistics
