// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/remembered/street_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "pipeline/ground/segmenter.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::remembered {
namespace {

using frame::Label;
using frame::Place;
using ground::Segmenter;
using ground::SegmenterConfig;
using test::Box;

constexpr Place kHere{.journey = 1};
const Box kHouse{15, 16, -30, -8, 0, 4};
const Box kCar{9, 13, -1, 1, 0.15, 1.5};
const Box kPedestrian{7, 7.4, 1, 1.5, 0, 1.8};
const Box kKerb{7, 9, -2, 2, 0, 0.25};

struct StreetMemoryTest : testing::Test, test::BoxScene {
  Segmenter remembering{SegmenterConfig{}, profile, kShape, image.return_capacity(), memory};
  Segmenter alone{SegmenterConfig{}, profile, kShape, image.return_capacity(), memory};

  stage::MemoryReport see(const std::vector<Box>& boxes, const Place& place) {
    cast(test::ground_with_boxes(boxes));
    remembering.set_place(place);
    const auto report = remembering.segment(image);
    (void)alone.segment(image);
    return report.memory;
  }
  std::vector<Label> remembered_labels() const {
    return {remembering.labels().begin(), remembering.labels().end()};
  }
  std::vector<Label> own_labels() const { return {alone.labels().begin(), alone.labels().end()}; }
};

TEST_F(StreetMemoryTest, WithoutMotionEveryFrameIsLabelledByItself) {
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_FALSE(see({kHouse, kCar}, Place{}).used);
    EXPECT_EQ(remembered_labels(), own_labels());
  }
}

TEST_F(StreetMemoryTest, TheFirstFrameOfAJourneyIsLabelledByItself) {
  EXPECT_FALSE(see({kHouse}, kHere).used);
  EXPECT_EQ(remembered_labels(), own_labels());
  EXPECT_TRUE(see({kHouse}, kHere).used);
  EXPECT_FALSE(see({kHouse, kCar}, {.journey = 2}).used);
  EXPECT_EQ(remembered_labels(), own_labels());
}

TEST_F(StreetMemoryTest, MotionThatIsMissingForgetsWhatWasBefore) {
  (void)see({kHouse}, kHere);
  (void)see({kHouse}, Place{});
  EXPECT_FALSE(see({kHouse}, kHere).used);
}

TEST_F(StreetMemoryTest, WhatAppearsIsAnObstacleInTheFirstFrameThatShowsIt) {
  for (int frame = 0; frame < 10; ++frame) (void)see({kHouse}, kHere);
  EXPECT_TRUE(see({kHouse, kCar, kPedestrian}, kHere).used);
  const auto labels = remembered_labels(), own = own_labels();
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_TRUE(own[i] != Label::kObstacle || labels[i] == Label::kObstacle) << i;
  }
}

TEST_F(StreetMemoryTest, ALowThingOnRememberedGroundIsAnObstacleWithinFourFramesAndStaysOne) {
  for (int frame = 0; frame < 5; ++frame) (void)see({kHouse}, kHere);
  for (int frame = 0; frame < 20; ++frame) {
    EXPECT_TRUE(see({kHouse, kKerb}, kHere).used);
    if (frame < 4) continue;
    const auto labels = remembered_labels(), own = own_labels();
    for (std::size_t i = 0; i < own.size(); ++i) {
      ASSERT_TRUE(own[i] != Label::kObstacle || labels[i] == Label::kObstacle) << frame << ' ' << i;
    }
  }
}

TEST_F(StreetMemoryTest, WhatLeavesLeavesNoGhost) {
  for (int frame = 0; frame < 10; ++frame) (void)see({kHouse, kCar, kPedestrian}, kHere);
  EXPECT_TRUE(see({kHouse}, kHere).used);
  const auto labels = remembered_labels(), own = own_labels();
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_TRUE(own[i] != Label::kGround || labels[i] == Label::kGround) << i;
  }
}

TEST_F(StreetMemoryTest, AWorldThatContradictsTheMotionIsForgotten) {
  SegmenterConfig config;
  config.memory.max_contradiction = 0;
  Segmenter doubting(config, profile, kShape, image.return_capacity(), memory);
  const auto walls_from = [](double first_m) {
    std::vector<Box> walls;
    for (double x = first_m; x < 30; x += 2) walls.push_back({x, x + 0.5, -20, 20, 0, 0.6});
    return walls;
  };
  const auto doubts = [&](const std::vector<Box>& boxes) {
    cast(test::ground_with_boxes(boxes));
    doubting.set_place(kHere);
    return doubting.segment(image).memory.contradicted;
  };
  EXPECT_FALSE(doubts(walls_from(6)));
  EXPECT_FALSE(doubts(walls_from(6)));
  EXPECT_TRUE(doubts(walls_from(7)));
  (void)alone.segment(image);
  EXPECT_TRUE(std::ranges::equal(doubting.labels(), alone.labels()));
}

TEST_F(StreetMemoryTest, TheSameDriveGivesTheSameLabels) {
  std::vector<std::vector<Label>> drives[2];
  for (auto& drive : drives) {
    Segmenter segmenter({}, profile, kShape, image.return_capacity(), memory);
    for (int frame = 0; frame < 4; ++frame) {
      cast(test::ground_with_boxes({{15.0 - frame, 16.0 - frame, -30, -8, 0, 4}}));
      segmenter.set_place({.journey = 1, .x_m = 1.0 * frame});
      (void)segmenter.segment(image);
      drive.emplace_back(segmenter.labels().begin(), segmenter.labels().end());
    }
  }
  EXPECT_EQ(drives[0], drives[1]);
}

TEST_F(StreetMemoryTest, RememberingAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  (void)see({kHouse}, kHere);
  const std::uint64_t before = test::allocations_of_this_thread();
  for (int frame = 0; frame < 3; ++frame) {
    remembering.set_place({.journey = 1, .x_m = 5.0 * frame, .y_m = -3.0 * frame});
    (void)remembering.segment(image);
  }
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

}  // namespace
}  // namespace terracut::remembered
