// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/complete_objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "pipeline/points/scene_of_points.hpp"
#include "tests/pipeline/points/point_of_cell.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::points {
namespace {

/// An object and the sector with which it came.
struct Came {
  CompleteObject found;
  int sector;
};

/// Boxes on level ground, seen in sectors of ten columns; what is higher than 5 cm is an obstacle.
struct ObjectsOfSectors : testing::Test, test::BoxScene {
  static constexpr int kColumnsASector = 10, kSectors = kShape.columns / kColumnsASector;
  static constexpr std::int64_t kSector_ns = 1'000'000;

  /// The points of a turn that begins at column `first_column` and goes one way or the other; its
  /// lasers look up to `aside` columns to either side of the head.
  void see(const std::vector<test::Box>& boxes, int first_column = 0, bool clockwise = true,
           int aside = 0) {
    cast(test::ground_with_boxes(boxes));
    points.clear();
    sector_of_point.clear();
    for (int i = 0; i < kShape.columns; ++i) {
      const int away = clockwise ? i : kShape.columns - i;
      for (int row = 0; row < kShape.rows; ++row) {
        const int of_laser = row * 17 % (2 * aside + 1) - aside;
        const int column = (first_column + away + of_laser + kShape.columns) % kShape.columns;
        const std::size_t cell = kShape.cell(row, column);
        if (!image.has_return(cell)) continue;
        points.push_back(test::point_of_cell(image, row, cell));
        sector_of_point.push_back(i / kColumnsASector);
      }
    }
    heights_m.clear();
    for (const LabelledPoint& point : points) heights_m.push_back(point.z_m);
  }
  /// Hands the first sectors of the next frame over, all but a lost one, and returns the objects
  /// that came.
  std::span<const Came> stream(int sectors = kSectors, int lost = -1) {
    came.clear();
    std::size_t first = 0;
    for (int sector = 0; sector < sectors; ++sector) {
      const auto end = static_cast<std::size_t>(std::ranges::upper_bound(sector_of_point, sector) -
                                                sector_of_point.begin());
      if (sector != lost) {
        const auto found = finder.take({frame, static_cast<std::uint32_t>(first),
                                        sector * kSector_ns, (sector + 1) * kSector_ns, 0},
                                       std::span(points).subspan(first, end - first),
                                       std::span(heights_m).subspan(first, end - first));
        for (const CompleteObject& of : found) came.push_back({of, sector});
      }
      first = end;
    }
    ++frame;
    return came;
  }
  /// The objects of the whole turn, in the order of their first returns.
  std::vector<objects::Object> whole() const {
    SceneOfPoints scene({.objects = true}, profile, kShape, points.size(), {});
    scene.find({}, points, heights_m);
    std::vector<objects::Object> all(scene.found().objects().begin(),
                                     scene.found().objects().end());
    std::ranges::sort(all, {}, &objects::Object::first_return);
    return all;
  }
  static void expect_same(const objects::Object& a, const objects::Object& b) {
    EXPECT_EQ(a.returns, b.returns);
    EXPECT_EQ(a.first_return, b.first_return);
    EXPECT_EQ(a.last_return, b.last_return);
    EXPECT_EQ(a.bottom_m, b.bottom_m);
    EXPECT_EQ(a.top_m, b.top_m);
    EXPECT_EQ(a.ground_z_m, b.ground_z_m);
    EXPECT_EQ(a.footprint.count, b.footprint.count);
    EXPECT_EQ(a.box.middle.x_m, b.box.middle.x_m);
    EXPECT_EQ(a.box.length_m, b.box.length_m);
  }

  std::vector<LabelledPoint> points;
  std::vector<int> sector_of_point;
  std::vector<float> heights_m;
  std::vector<Came> came;
  std::uint32_t frame = 0;
  CompleteObjects finder{profile, kShape, static_cast<std::size_t>(kShape.rows* kShape.columns)};

  /// Around the vehicle, none straight ahead: two cars, a person, a wall and a post before it. One
  /// car's side, seen aslant, falls apart.
  const std::vector<test::Box> kAround{{3, 7, -6, -4.2, 0, 1.5},
                                       {-0.3, 0, -9, -8.5, 0, 1.75},
                                       {-20, 5, 15, 16, 0, 4},
                                       {-5, -4.9, 12, 12.1, 0, 3},
                                       {-12, -7.5, -3, -1.2, 0, 1.6}};
};

TEST_F(ObjectsOfSectors, AreThoseOfTheWholeTurn) {
  see(kAround);
  (void)stream();
  std::ranges::sort(came, {}, [](const Came& of) { return of.found.object.first_return; });
  const auto expected = whole();
  ASSERT_GE(expected.size(), kAround.size());
  ASSERT_EQ(came.size(), expected.size());
  for (std::size_t i = 0; i < came.size(); ++i) expect_same(came[i].found.object, expected[i]);
}

TEST_F(ObjectsOfSectors, ComeSomeSectorsAfterTheirLastReturn) {
  see(kAround);
  for (const Came& of : stream()) {
    const objects::Object& object = of.found.object;
    const int last = sector_of_point[object.last_return];
    const double nearest_m =
        std::hypot(object.box.middle.x_m, object.box.middle.y_m) - object.box.length_m / 2;
    const double sectors_of_a_metre = 1 / nearest_m / 6.283 * kSectors;
    EXPECT_GT(of.sector, last);
    EXPECT_LE(of.sector, last + sectors_of_a_metre + CompleteObjects::kSectorsALook + 1);
    EXPECT_EQ(of.found.last_packet_ns, last * kSector_ns);
  }
}

TEST_F(ObjectsOfSectors, AreWholeWhereTurnsFollowEachOther) {
  see({{10, 14, -0.9, 0.9, 0, 1.5}});
  EXPECT_TRUE(stream().empty());
  ASSERT_EQ(stream().size(), 1U);
  const CompleteObject& found = came[0].found;
  const objects::Object expected = whole()[0];
  EXPECT_EQ(found.object.returns, expected.returns);
  EXPECT_EQ(found.object.box.length_m, expected.box.length_m);
  EXPECT_EQ(found.frame, 1U);
  EXPECT_EQ(found.object.first_return, expected.first_return);
  EXPECT_LT(sector_of_point[found.object.last_return], kSectors / 2);
  EXPECT_LT(came[0].sector, kSectors / 2);
}

TEST_F(ObjectsOfSectors, AtTheEndOfATurnComeWithTheNextButAreOfTheirFrame) {
  see({{10, 10.5, 1.2, 1.7, 0, 1.7}});
  EXPECT_TRUE(stream().empty());
  ASSERT_EQ(stream().size(), 1U);
  EXPECT_EQ(came[0].found.frame, 0U);
  expect_same(came[0].found.object, whole()[0]);
}

TEST_F(ObjectsOfSectors, OfATurnThatBeginsAnywhereAndGoesEitherWayAreTheSame) {
  for (const int first_column : {0, 250, 700}) {
    for (const bool clockwise : {true, false}) {
      see({{10, 14, -0.9, 0.9, 0, 1.5}, {-14, -10, -9, -7, 0, 1.5}}, first_column, clockwise);
      const auto expected = whole();
      const std::size_t at_the_beginning = first_column == 0 ? 1 : 0;
      ++frame;  // begins anew
      ASSERT_EQ(stream().size(), 2 - at_the_beginning) << first_column << " " << clockwise;
      for (const Came& of : came) {
        const auto same = std::ranges::find(expected, of.found.object.first_return,
                                            &objects::Object::first_return);
        ASSERT_NE(same, expected.end());
        expect_same(of.found.object, *same);
      }
    }
  }
}

TEST_F(ObjectsOfSectors, OfLasersThatLookAsideAreTheSame) {
  for (const bool clockwise : {true, false}) {
    see(kAround, 0, clockwise, 25);
    ++frame;  // begins anew
    (void)stream();
    EXPECT_EQ(stream().size(), whole().size());
  }
}

TEST_F(ObjectsOfSectors, AreForgottenWhereFramesAreMissing) {
  see({{-14, -10, -0.9, 0.9, 0, 1.5}});
  EXPECT_TRUE(stream(kSectors / 2).empty());
  ++frame;
  see({{-1, 1, -12, -10, 0, 1.5}});
  ASSERT_EQ(stream().size(), 1U);
  expect_same(came[0].found.object, whole()[0]);
}

TEST_F(ObjectsOfSectors, ThatGoAroundTheSensorComeOnceTheyEnd) {
  see({{-20, 20, 10, 11, 0, 3},
       {-20, 20, -11, -10, 0, 3},
       {19, 20, -11, 11, 0, 3},
       {-20, -19, -11, 11, 0, 3}});
  ASSERT_EQ(whole().size(), 1U);
  for (int turn = 0; turn < 3; ++turn) EXPECT_TRUE(stream().empty());
  see({});
  ASSERT_EQ(stream().size(), 1U);
  EXPECT_EQ(came[0].found.frame, 2U);
}

TEST_F(ObjectsOfSectors, AreFoundBehindALostSectorToo) {
  see(kAround);
  constexpr int kEmpty = 6;  // nothing stands there
  EXPECT_EQ(stream(kSectors, kEmpty).size(), whole().size());
}

TEST_F(ObjectsOfSectors, AreFoundWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  see(kAround);
  const std::size_t found = stream().size();
  const std::uint64_t before = test::allocations_of_this_thread();
  EXPECT_EQ(stream().size(), found);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::points
