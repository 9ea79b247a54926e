// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/objects/object_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::objects {
namespace {

using frame::Label;

/// Boxes on level ground. What is higher than 5 cm is an obstacle, so that only objects are tested.
struct ObjectsOfAFrame : testing::Test, test::BoxScene {
  std::span<const Object> find(const std::vector<test::Box>& boxes) {
    cast(test::ground_with_boxes(boxes));
    return find_again();
  }
  std::span<const Object> find_again() {
    labels.assign(image.returns(), Label::kNone);
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      planes.height_m[cell] = image.has_return(cell) ? image.z_m()[cell] : NAN;
      planes.label[cell] = Label::kNone;
      if (!image.has_return(cell)) continue;
      planes.label[cell] = image.z_m()[cell] > 0.05F ? Label::kObstacle : Label::kGround;
      labels[image.return_index()[cell]] = planes.label[cell];
    }
    finder.find(image, planes, labels);
    return finder.objects();
  }
  /// The objects that have returns in a rectangle.
  std::set<int> objects_in(double near_m, double far_m, double right_m, double left_m) const {
    std::set<int> numbers;
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      const float x = image.x_m()[cell], y = image.y_m()[cell];
      if (!image.has_return(cell) || planes.label[cell] != Label::kObstacle) continue;
      if (x < near_m || x > far_m || y < right_m || y > left_m) continue;
      numbers.insert(finder.object_of_return()[image.return_index()[cell]]);
    }
    return numbers;
  }

  stage::CellPlanes planes{kShape, memory};
  std::vector<Label> labels;
  ObjectFinder finder{{}, profile, kShape, image.return_capacity(), memory};
};

TEST_F(ObjectsOfAFrame, AreNoneOnBareGround) {
  EXPECT_TRUE(find({}).empty());
  EXPECT_TRUE(std::ranges::all_of(finder.object_of_return(), [](auto n) { return n == 0; }));
}

TEST_F(ObjectsOfAFrame, TwoPersonsHalfAMetreApartAt15MetresAreTwo) {
  const auto found = find({{15, 15.3, 2.0, 2.5, 0, 1.75}, {15, 15.3, 3.0, 3.5, 0, 1.75}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NE(objects_in(14, 16, 2.0, 2.5), objects_in(14, 16, 3.0, 3.5));
}

TEST_F(ObjectsOfAFrame, APersonIsNotJoinedByWhatHangsBesideButACarIs) {
  find({{15, 15.3, 2.0, 2.5, 0, 1.75}, {15, 15.2, 2.95, 3.15, 0.6, 1.0}});
  const std::set<int> person = objects_in(14, 16, 1.9, 2.6), beside = objects_in(14, 16, 2.9, 3.2);
  ASSERT_FALSE(person.empty() || beside.empty());
  ASSERT_NE(*person.rbegin(), 0) << "only the lowest returns are no object's";
  EXPECT_FALSE(beside.contains(*person.rbegin()));
  find({{15, 17, 0, 2.5, 0, 1.75}, {15, 15.2, 2.95, 3.15, 0.6, 1.0}});
  EXPECT_TRUE(objects_in(14, 16, 0, 2.6).contains(*objects_in(14, 16, 2.9, 3.2).rbegin()));
  EXPECT_FALSE(objects_in(14, 16, 2.9, 3.2).contains(0));
}

TEST_F(ObjectsOfAFrame, ACarBehindAPoleIsOne) {
  const auto found = find({{10, 10.1, 1.4, 1.5, 0, 4}, {14, 18, -1, 3.5, 0.2, 1.5}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(objects_in(13, 19, -2, 6).size(), 1U) << "the car is whole on both sides of the pole";
  EXPECT_LT(found[0].box.length_m, 0.2F) << "a thin pole is an object";
}

TEST_F(ObjectsOfAFrame, ACarBehindABroadPostIsOneWhereverThePostStands) {
  for (double y = 1; y < 2; y += 0.1) {
    EXPECT_EQ(find({{6, 6.1, y, y + 0.2, 0, 4}, {14, 18, -1, 5.5, 0.2, 1.5}}).size(), 2U)
        << y << " m to the left";
  }
}

TEST_F(ObjectsOfAFrame, IsWholeAcrossTheSeam) {
  const auto found = find({{12, 14, -1, 1, 0, 1.5}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].box.length_m, 2, 0.15);
}

TEST_F(ObjectsOfAFrame, AreNotLookedForInReturnsTooScatteredToBeKeptAndTheseAreCounted) {
  find({{12, 14, -1, 1, 0, 1.5}});
  EXPECT_EQ(finder.cells_left_out(), 0U);
  // No two neighbours are within reach of each other.
  cast([](double azimuth_rad, double) {
    const int column = static_cast<int>(azimuth_rad / (2 * M_PI) * kShape.columns + 0.5);
    return column % 2 == 0 ? 10 : 20;
  });
  for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
    planes.label[cell] = image.has_return(cell) ? Label::kObstacle : Label::kNone;
    planes.height_m[cell] = 1;
  }
  labels.assign(image.returns(), Label::kObstacle);
  finder.find(image, planes, labels);
  EXPECT_GT(finder.cells_left_out(), 0U);
  EXPECT_LT(finder.cells_left_out(), image.returns());
}

TEST_F(ObjectsOfAFrame, WheelsBelongToTheirCarAndGrassAroundAPostDoesNot) {
  find({{20, 24, -2, 2, 0, 1.5}});
  EXPECT_FALSE(objects_in(19, 25, -3, 3).contains(0)) << "the car's lowest returns, too";
  const auto found = find({{8, 8.1, 3, 3.1, 0, 2.5}, {6.5, 9.5, 1.5, 4.5, 0, 0.12}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(found[0].box.length_m, 0.6F);
  EXPECT_TRUE(objects_in(6, 7.5, 1, 5).contains(0));
}

TEST_F(ObjectsOfAFrame, LowReturnsOfASlantingFaceBelongToItButForTheLowest) {
  // A face 2 m wide that leans back by 0.8 m a metre.
  const test::BeamCast ground = test::ground_with_boxes({});
  cast([&](double azimuth_rad, double elevation_rad) {
    const double ahead = std::cos(elevation_rad) * std::cos(azimuth_rad),
                 up = std::sin(elevation_rad);
    const double face_m = (1.73 + 10 / 0.8) / (ahead / 0.8 - up);
    const double z_m = 1.73 + face_m * up,
                 y_m = face_m * std::cos(elevation_rad) * std::sin(azimuth_rad);
    return ahead > 0 && z_m > 0 && z_m < 1.5 && std::abs(y_m) < 1
               ? face_m
               : ground(azimuth_rad, elevation_rad);
  });
  ASSERT_EQ(find_again().size(), 1U);
  std::size_t low = 0;
  for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
    const float z_m = image.z_m()[cell];
    if (!image.has_return(cell) || planes.label[cell] != Label::kObstacle) continue;
    if (std::abs(image.y_m()[cell]) > 0.8F) continue;  // the cell above may miss the face
    const int object = finder.object_of_return()[image.return_index()[cell]];
    EXPECT_EQ(object, z_m < 0.1F ? 0 : 1) << z_m;
    low += z_m < 0.25F && object == 1 ? 1 : 0;
  }
  EXPECT_GT(low, 10U);
}

TEST_F(ObjectsOfAFrame, SomethingLowByItselfIsOne) {
  EXPECT_EQ(find({{10, 10.5, 2, 3.7, 0, 0.28}}).size(), 1U) << "a person who lies on the road";
  EXPECT_TRUE(find({{10, 10.5, 2, 3.7, 0, 0.10}}).empty()) << "a plank";
}

TEST_F(ObjectsOfAFrame, HasItsMeasuresInTheVehicleFrame) {
  const auto found = find({{12, 16, 3, 4.8, 0, 1.5}});
  ASSERT_EQ(found.size(), 1U);
  const Object& car = found[0];
  EXPECT_NEAR(car.top_m, 1.5, 0.15);
  EXPECT_NEAR(car.bottom_m, 0.1, 0.25);
  EXPECT_NEAR(car.box.length_m, 4, 0.3) << "of the sides that are seen";
  EXPECT_NEAR(car.box.width_m, 1.8, 0.2);
  EXPECT_NEAR(std::abs(car.box.along.x_m), 1, 0.01);
  EXPECT_NEAR(car.box.middle.x_m, 14, 0.2);
  EXPECT_NEAR(car.box.middle.y_m, 3.9, 0.2);
  EXPECT_LT(car.first_return, car.last_return);
  const auto numbered = std::ranges::count(finder.object_of_return(), 1);
  EXPECT_EQ(car.returns, static_cast<std::uint32_t>(numbered));
}

TEST_F(ObjectsOfAFrame, FootprintIsConvexAndCounterclockwise) {
  const Footprint footprint = find({{12, 16, 3, 4.8, 0, 1.5}})[0].footprint;
  ASSERT_GE(footprint.count, 3U);
  for (std::uint32_t i = 0; i < footprint.count; ++i) {
    const Corner& a = footprint.corners[i];
    const Corner& b = footprint.corners[(i + 1) % footprint.count];
    const Corner& c = footprint.corners[(i + 2) % footprint.count];
    const double turn = (b.x_m - a.x_m) * (c.y_m - b.y_m) - (b.y_m - a.y_m) * (c.x_m - b.x_m);
    EXPECT_GE(turn, -1e-6) << "corner " << i;
  }
}

TEST_F(ObjectsOfAFrame, AreTheSameAgainAndAllocateNothing) {
  const std::vector<test::Box> boxes{{12, 16, 3, 4.8, 0, 1.5}, {8, 8.1, -3, -2.9, 0, 2.5}};
  find(boxes);
  const std::vector<std::uint16_t> first(finder.object_of_return().begin(),
                                         finder.object_of_return().end());
  find({{20, 22, -3, 4, 0, 3}});
  find(boxes);
  EXPECT_TRUE(std::ranges::equal(first, finder.object_of_return()));
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  const std::uint64_t before = test::allocations_of_this_thread();
  finder.find(image, planes, labels);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::objects
