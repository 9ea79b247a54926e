// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/fixed_grid_elevation_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/support/box_scene.hpp"

namespace terracut::baselines {
namespace {

using SquareKind = FixedGridElevationMap::SquareKind;

struct FixedGridOnScenes : testing::Test, test::BoxScene {
  FixedGridElevationMap& segment(const test::BeamCast& beams,
                                 const FixedGridElevationMap::Config& config = {}) {
    cast(beams);
    map.emplace(config, profile, kShape, image.return_capacity(), memory);
    report = map->segment(image);
    return *map;
  }
  std::optional<FixedGridElevationMap> map;
  stage::SegmentationReport report;
};

TEST_F(FixedGridOnScenes, FlatGroundIsLevelEverywhereAndAllGround) {
  segment(test::flat_ground());
  EXPECT_GT(report.returns, 50'000U);
  EXPECT_EQ(report.ground, report.returns);
  EXPECT_EQ(map->square_at(8, 1).kind, SquareKind::kLevel);
  EXPECT_NEAR(map->square_at(8, 1).elevation_m, 0, 1e-4);
  EXPECT_EQ(map->square_at(1, 0).kind, SquareKind::kEmpty);  // nearer than the first ring
}

TEST_F(FixedGridOnScenes, AWallIsAVerticalObjectWhoseFootIsTheElevation) {
  segment(test::ground_with_boxes({{12.2, 13, -4, 4, 0, 2}}));
  const auto& square = map->square_at(12.3F, 0.2F);
  EXPECT_EQ(square.kind, SquareKind::kVertical);
  EXPECT_NEAR(square.elevation_m, 0, 0.06);
  EXPECT_TRUE(std::isinf(square.overhang_m));
  const auto high = [](float, float, float z) { return z > 0.35F; };
  EXPECT_EQ(share(map->labels(), frame::Label::kObstacle, high), 1.0);
  const auto road = [](float x, float, float z) { return x < 11 && z < 0.01F; };
  EXPECT_EQ(share(map->labels(), frame::Label::kGround, road), 1.0);
}

TEST_F(FixedGridOnScenes, ABridgeHangsOverTheRoadWhichStaysGround) {
  // Squares as wide as the rings of the road below are apart: each sees both.
  FixedGridElevationMap::Config wide;
  wide.cell_m = 2.0F;
  segment(test::ground_with_boxes({{20, 24, -10, 10, 2.4, 2.6}}), wide);
  const auto overhead = [](float, float, float z) { return z > 1.0F; };
  EXPECT_EQ(share(map->labels(), frame::Label::kObstacle, overhead), 1.0);
  const auto road = [](float x, float y, float z) {
    return x > 19 && x < 25 && std::fabs(y) < 9 && z < 0.01F;
  };
  EXPECT_EQ(share(map->labels(), frame::Label::kGround, road), 1.0);
}

TEST_F(FixedGridOnScenes, AGapTheVehicleFitsThroughSeparatesWhatHangsOver) {
  // Returns put by hand into one square: road, and a sign above it.
  image.clear();
  for (int i = 0; i < 10; ++i) {
    image.place(0, i, {10.1F, 0.1F, 0.01F * static_cast<float>(i % 2), 10.1F, 0});
    image.place(1, i, {10.1F, 0.1F, 3.0F + 0.2F * static_cast<float>(i), 10.1F, 0});
  }
  FixedGridElevationMap fits({}, profile, kShape, image.return_capacity(), memory);
  (void)fits.segment(image);
  EXPECT_EQ(fits.square_at(10.1F, 0.1F).kind, SquareKind::kLevel);
  EXPECT_NEAR(fits.square_at(10.1F, 0.1F).elevation_m, 0.005, 1e-4);
  EXPECT_EQ(fits.square_at(10.1F, 0.1F).overhang_m, 3.0F);

  FixedGridElevationMap::Config tall;
  tall.vehicle_height_m = 3.5F;
  FixedGridElevationMap too_tall(tall, profile, kShape, image.return_capacity(), memory);
  (void)too_tall.segment(image);
  EXPECT_EQ(too_tall.square_at(10.1F, 0.1F).kind, SquareKind::kVertical);
  EXPECT_TRUE(std::isinf(too_tall.square_at(10.1F, 0.1F).overhang_m));
}

TEST_F(FixedGridOnScenes, NearReturnsCountMoreThanFarOnesInALevel) {
  image.clear();
  image.place(0, 0, {10.1F, 0.1F, 0.00F, 0.0F, 0});
  image.place(0, 1, {10.1F, 0.1F, 0.06F, 20.0F, 0});  // twice the deviation: a quarter the weight
  FixedGridElevationMap fused({}, profile, kShape, image.return_capacity(), memory);
  (void)fused.segment(image);
  EXPECT_NEAR(fused.square_at(10.1F, 0.1F).elevation_m, 0.06 * 0.25 / 1.25, 1e-5);
}

TEST_F(FixedGridOnScenes, ASlopeBreaksTheFlatSquareAssumption) {
  // 0.45 m rise over the side of a square, more than an obstacle's height: the paper's argument
  // against fixed squares. A gentle slope passes.
  segment(test::sloping_ground(0.10));
  EXPECT_EQ(report.obstacles, 0U);
  FixedGridElevationMap::Config coarse;
  coarse.cell_m = 3.0F;
  segment(test::sloping_ground(0.15), coarse);
  EXPECT_GT(report.obstacles, report.returns / 50);
}

TEST_F(FixedGridOnScenes, ARoofAloneInItsSquareIsTakenForGround) {
  // Seen from a high mount; no square within the roof holds a return of the ground.
  profile = test::even_profile(64, -40, -2, 4.0);
  segment(test::ground_with_boxes({{8, 12, -1, 1, 0, 1.5}}, 4.0));
  const auto inner_roof = [](float x, float y, float z) {
    return x > 9 && x < 11.5F && std::fabs(y) < 0.9F && z > 1.45F;
  };
  EXPECT_EQ(share(map->labels(), frame::Label::kGround, inner_roof), 1.0);
}

TEST_F(FixedGridOnScenes, ReturnsBeyondTheMapBelongToItsEdge) {
  FixedGridElevationMap::Config small;
  small.extent_m = 10;
  segment(test::flat_ground(), small);
  EXPECT_EQ(report.ground, report.returns);
  EXPECT_EQ(&map->square_at(1e9F, 0), &map->square_at(9.9F, 0));
  EXPECT_EQ(&map->square_at(NAN, 0), &map->square_at(-9.9F, 0));
}

}  // namespace
}  // namespace terracut::baselines
