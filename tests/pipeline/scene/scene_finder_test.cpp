// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/scene/scene_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "pipeline/ground/segmenter.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::scene {
namespace {

/// A labelled frame: two cars, a person, a kerb and a low bar.
struct LabelledScene : testing::Test, test::BoxScene {
  LabelledScene() {
    cast(test::ground_with_boxes({{12, 16, 3, 4.8, 0.2, 1.5},
                                  {10, 10.4, -3, -2.5, 0, 1.7},
                                  {12, 14, -1, 1, 0.2, 1.5},
                                  {4, 30, 6, 8, 0, 0.12},
                                  {7, 7.2, -1, 1, 0, 0.14}}));
    (void)method.segment(image);
  }
  void find(SceneFinder& finder) const { finder.find(image, method.labels(), method.heights_m()); }

  ground::Segmenter method{[] {
                             ground::SegmenterConfig config;
                             config.gives_heights = true;
                             return config;
                           }(),
                           profile, kShape, image.return_capacity(), memory};
};

TEST_F(LabelledScene, HasTheObjectsThatTheMethodsOwnCellsShow) {
  objects::ObjectFinder of_cells({}, profile, kShape, image.return_capacity(), memory);
  of_cells.find(image, method.planes(), method.labels());
  SceneFinder finder({.objects = true}, profile, kShape, image.return_capacity(), memory);
  find(finder);
  EXPECT_GE(finder.objects().size(), 3U);
  EXPECT_EQ(finder.objects().size(), of_cells.objects().size());
  EXPECT_TRUE(std::ranges::equal(finder.object_of_return(), of_cells.object_of_return()));
}

TEST_F(LabelledScene, HasTheFreeWayThatTheMethodsOwnCellsShow) {
  free_way::FreeWay of_cells({}, profile, kShape, memory);
  of_cells.find(image, method.planes(), method.labels());
  SceneFinder finder({.free_way = true}, profile, kShape, image.return_capacity(), memory);
  find(finder);
  ASSERT_EQ(finder.free_way().size(), of_cells.sectors().size());
  int near = 0;
  for (std::size_t i = 0; i < finder.free_way().size(); ++i) {
    const free_way::Sector &found = finder.free_way()[i], &expected = of_cells.sectors()[i];
    EXPECT_EQ(found.obstacle_m, expected.obstacle_m) << i;
    EXPECT_EQ(found.seen_m, expected.seen_m) << i;
    EXPECT_EQ(found.seen_end, expected.seen_end) << i;
    near += found.obstacle_m < 7.5F ? 1 : 0;
  }
  EXPECT_GT(near, 20) << "the low bar";
}

TEST_F(LabelledScene, HasNothingThatIsNotWanted) {
  SceneFinder objects({.objects = true}, profile, kShape, image.return_capacity(), memory);
  SceneFinder free_way({.free_way = true}, profile, kShape, image.return_capacity(), memory);
  find(objects);
  find(free_way);
  EXPECT_TRUE(objects.free_way().empty());
  EXPECT_TRUE(free_way.objects().empty());
  EXPECT_TRUE(free_way.object_of_return().empty());
}

TEST_F(LabelledScene, IsFoundWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  SceneFinder finder({.objects = true, .free_way = true}, profile, kShape, image.return_capacity(),
                     memory);
  const std::uint64_t before = test::allocations_of_this_thread();
  find(finder);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::scene
