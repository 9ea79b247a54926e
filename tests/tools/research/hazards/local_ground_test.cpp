// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/local_ground.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace terracut::hazards {
namespace {

TEST(LocalGround, FollowsASlopeWhateverLiesOnIt) {
  std::vector<Eigen::Vector3d> points;
  for (int x = -5; x <= 5; ++x) {
    for (int y = -5; y <= 5; ++y) {
      const double lies_m = (x + 7 * y) % 10 == 0 ? 0.8 : 0;
      points.emplace_back(10 + 0.5 * x, 3 + 0.5 * y, 0.2 + 0.1 * 0.5 * x + lies_m);
    }
  }
  const auto ground = local_ground(points, 10, 3);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, 0.2, 0.02);
  EXPECT_NEAR(ground->rise_x, 0.1, 0.01);
  EXPECT_NEAR(ground->rise_y, 0.0, 0.01);
}

TEST(LocalGround, OfOneRowIsLevelAcrossIt) {
  std::vector<Eigen::Vector3d> points;
  for (int i = -20; i <= 20; ++i) points.emplace_back(30 + 0.002 * i, 0.1 * i, 0.5 + 0.01 * i);
  const auto ground = local_ground(points, 30, 0);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height_m, 0.5, 0.01);
  EXPECT_NEAR(ground->rise_x, 0, 0.01);
  EXPECT_NEAR(ground->rise_y, 0.1, 0.01);
}

TEST(LocalGround, IsNotSeenInFivePoints) {
  EXPECT_FALSE(local_ground(std::vector<Eigen::Vector3d>(5), 0, 0));
  EXPECT_TRUE(local_ground(std::vector<Eigen::Vector3d>(6), 0, 0));
}

}  // namespace
}  // namespace terracut::hazards
