// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/research/hazards/flat_scene.hpp"
#include "tools/research/eval/method_bench.hpp"
#include "tools/research/free_measures/free_trials.hpp"
#include "tools/research/free_measures/true_way.hpp"

namespace terracut::free_measures {
namespace {

TEST(TrueWay, IsTheNearestReturnOfAnObstacleAbovetheGround) {
  const hazards::FlatScene scene(10);
  memory::FixedMemory memory;
  const free_way::FreeWay free_way({}, scene.profile, scene.shape, memory);
  const auto true_m = true_obstacles_m(scene.labelled(), scene.classes, free_way, {});
  EXPECT_NEAR(true_m[0], 10, 0.05);
  EXPECT_TRUE(std::isinf(true_m[180])) << "nothing stands to the right";
  EXPECT_EQ(sector_of(free_way, 0), 0U);
  EXPECT_EQ(sector_of(free_way, scene.shape.columns - 1), 719U);
}

TEST(FreeTrials, FindTheCarTheBoxesAndThePitsOfAFlatScene) {
  const hazards::FlatScene scene(12);
  const std::vector<eval::MethodChoice> methods{*eval::method_named("terracut")};
  memory::FixedMemory memory;
  eval::MethodBench bench(methods, scene.profile, scene.shape, scene.image.return_capacity(),
                          memory);
  (void)bench.segment(0, scene.image);
  FreeTrials trials(methods, scene.classes, 2, 1);
  const std::string sequence = "flat", frame = "000000";
  trials.look({sequence, frame, scene.image, scene.profile, scene.truth,
               [&](std::size_t i) { return bench.labels(i); },
               [&](std::size_t i) -> decltype(auto) { return bench.planes(i); }});
  const FreeCounts& counts = trials.counts(0);
  EXPECT_EQ(counts.frames, 1U);
  EXPECT_EQ(counts.sectors, 720U);
  EXPECT_GT(counts.obstacles.right, 60U) << "the car";
  EXPECT_EQ(counts.obstacles.farther, 0U);
  EXPECT_EQ(counts.obstacles.nearer, 0U);
  for (const PutIn& of_bin : {counts.boxes[0], counts.pits[0]}) {
    EXPECT_EQ(of_bin.trials, 2U);
    EXPECT_EQ(of_bin.failed, 0U);
    EXPECT_LE(of_bin.worst_m, 0.2);
  }
}

}  // namespace
}  // namespace terracut::free_measures
