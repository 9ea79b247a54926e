// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/scene_of_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::points {
namespace {

using frame::Label;

/// Two cars and a person on level ground, as labelled points; what is higher than 5 cm is an
/// obstacle.
struct PointsOfATurn : testing::Test, test::BoxScene {
  PointsOfATurn() {
    cast(test::ground_with_boxes(
        {{12, 16, 3, 4.8, 0, 1.5}, {10, 10.4, -3, -2.5, 0, 1.7}, {12, 14, -1, 1, 0, 1.5}}));
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const std::size_t cell = kShape.cell(row, column);
        if (!image.has_return(cell)) continue;
        const float z_m = image.z_m()[cell];
        points.push_back({image.x_m()[cell], image.y_m()[cell], z_m, 0,
                          z_m > 0.05F ? Label::kObstacle : Label::kGround,
                          static_cast<std::uint16_t>(row), 0});
      }
    }
  }
  void find(SceneOfPoints& finder) {
    heights_m.clear();
    for (const LabelledPoint& point : points) heights_m.push_back(point.z_m);
    finder.find(points, heights_m);
  }
  /// The number of each object's points, by the object's least x.
  std::map<int, int> sizes(const SceneOfPoints& finder) const {
    std::map<int, int> sizes, least_x_cm;
    for (std::size_t i = 0; i < finder.found().object_of_return().size(); ++i) {
      const int number = finder.found().object_of_return()[i];
      const auto x_cm = static_cast<int>(points[i].x_m * 100);
      const auto [at, is_new] = least_x_cm.try_emplace(number, x_cm);
      at->second = std::min(at->second, x_cm);
    }
    for (const std::uint16_t number : finder.found().object_of_return()) {
      if (number != 0) ++sizes[least_x_cm[number]];
    }
    return sizes;
  }

  std::vector<LabelledPoint> points;
  std::vector<float> heights_m;
};

TEST_F(PointsOfATurn, HaveTheObjectsThatStandThere) {
  SceneOfPoints finder({.objects = true}, profile, kShape, points.size());
  find(finder);
  ASSERT_EQ(finder.found().objects().size(), 3U);
  for (const objects::Object& object : finder.found().objects()) {
    EXPECT_GT(object.top_m, 1.3F);
    EXPECT_NEAR(object.ground_z_m, 0, 1e-5);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].label != Label::kGround) continue;
    EXPECT_EQ(finder.found().object_of_return()[i], 0);
  }
}

TEST_F(PointsOfATurn, HaveTheSameObjectsInAnyOrder) {
  SceneOfPoints finder({.objects = true}, profile, kShape, points.size());
  find(finder);
  const auto before = sizes(finder);
  std::ranges::shuffle(points, std::mt19937(7));
  find(finder);
  EXPECT_EQ(sizes(finder), before);
}

TEST_F(PointsOfATurn, BeyondTheMostBelongToNoObject) {
  SceneOfPoints finder({.objects = true}, profile, kShape, 1000);
  find(finder);
  EXPECT_EQ(finder.found().object_of_return().size(), 1000U);
}

TEST_F(PointsOfATurn, AreLookedAtWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  SceneOfPoints finder({.objects = true}, profile, kShape, points.size());
  find(finder);
  const std::uint64_t before = test::allocations_of_this_thread();
  finder.find(points, heights_m);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::points
