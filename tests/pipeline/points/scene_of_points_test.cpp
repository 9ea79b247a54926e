// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/scene_of_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "firmware_io/vehicle/planar_pose.hpp"
#include "tests/pipeline/points/point_of_cell.hpp"
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
        points.push_back(test::point_of_cell(image, row, cell));
      }
    }
  }
  void find(SceneOfPoints& finder, const frame::FrameInfo& info = {}) {
    heights_m.clear();
    for (const LabelledPoint& point : points) heights_m.push_back(point.z_m);
    finder.find(info, points, heights_m);
  }
  /// Compares with the free way of the image from which the points are.
  void expect_free_way_of_image(const SceneOfPoints& finder, float within_m) {
    scene::SceneFinder of_image({.free_way = true}, profile, kShape, points.size(), memory);
    std::vector<Label> labels(points.size());
    std::vector<float> by_return_m(points.size());
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      if (!image.has_return(cell)) continue;
      const float z_m = image.z_m()[cell];
      const std::uint32_t index = image.return_index()[cell];
      labels[index] = z_m > 0.05F ? Label::kObstacle : Label::kGround;
      by_return_m[index] = z_m;
    }
    of_image.find(image, labels, by_return_m);
    int near = 0, alike = 0;
    for (std::size_t i = 0; i < of_image.free_way().size(); ++i) {
      const free_way::Sector &found = finder.found().free_way()[i],
                             &expected = of_image.free_way()[i];
      const bool has_same_obstacle = found.obstacle_m == expected.obstacle_m ||
                                     std::abs(found.obstacle_m - expected.obstacle_m) <= within_m;
      alike += has_same_obstacle && std::abs(found.seen_m - expected.seen_m) <= within_m ? 1 : 0;
      near += expected.obstacle_m < 13 ? 1 : 0;
    }
    EXPECT_GT(near, 30);
    EXPECT_EQ(alike, 720);
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
  SceneOfPoints finder({.objects = true}, profile, kShape, points.size(), {});
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
  SceneOfPoints finder({.objects = true}, profile, kShape, points.size(), {});
  find(finder);
  const auto before = sizes(finder);
  std::ranges::shuffle(points, std::mt19937(7));
  find(finder);
  EXPECT_EQ(sizes(finder), before);
}

TEST_F(PointsOfATurn, HaveTheFreeWayOfTheImage) {
  SceneOfPoints finder({.free_way = true}, profile, kShape, points.size(), {});
  find(finder);
  expect_free_way_of_image(finder, 0.001F);
}

/// A vehicle of 20 m/s that turns by 0.4 rad/s; deskewed to the end of the turn.
TEST_F(PointsOfATurn, HaveTheFreeWayAsMeasuredAlsoWhenTheyWereDeskewed) {
  constexpr double kTurn_s = 0.1;
  frame::FrameInfo info;
  info.first_packet_ns = 1'000'000'000;
  info.last_packet_ns = 1'100'000'000;
  info.head = {0, 1};
  info.deskew.state = frame::DeskewState::kDone;
  const auto motion_at = [](double time_s) {
    return vehicle::after_constant_motion(20, 0.4, time_s - kTurn_s);
  };
  const auto moved = [&](double time_s) -> frame::DeskewInfo::Moved {
    const vehicle::PlanarPose pose = motion_at(time_s);
    return {info.first_packet_ns + static_cast<std::int64_t>(time_s * 1e9),
            {static_cast<float>(pose.cosine), static_cast<float>(pose.sine),
             static_cast<float>(pose.x_m), static_cast<float>(pose.y_m)}};
  };
  info.deskew.moved = {moved(-0.002), moved(0.051), moved(kTurn_s + 0.003)};
  for (LabelledPoint& point : points) {
    double turns = std::atan2(-point.y_m, point.x_m) / (2 * std::numbers::pi);
    if (turns < 0) turns += 1;
    point.time_s = static_cast<float>(turns * kTurn_s);
    const vehicle::PlanarPose pose = motion_at(turns * kTurn_s);
    const double x_m = point.x_m, y_m = point.y_m;
    point.x_m = static_cast<float>(pose.cosine * x_m - pose.sine * y_m + pose.x_m);
    point.y_m = static_cast<float>(pose.sine * x_m + pose.cosine * y_m + pose.y_m);
  }
  const std::vector<float> straight(kShape.rows);  // no beam points beside the head
  SceneOfPoints finder({.free_way = true}, profile, kShape, points.size(), straight);
  find(finder, info);
  expect_free_way_of_image(finder, 0.01F);
}

TEST_F(PointsOfATurn, BeyondTheMostBelongToNoObject) {
  SceneOfPoints finder({.objects = true}, profile, kShape, 1000, {});
  find(finder);
  EXPECT_EQ(finder.found().object_of_return().size(), 1000U);
}

TEST_F(PointsOfATurn, AreLookedAtWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  SceneOfPoints finder({.objects = true}, profile, kShape, points.size(), {});
  find(finder);
  const std::uint64_t before = test::allocations_of_this_thread();
  finder.find({}, points, heights_m);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::points
