// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/height_field_mrf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/support/box_scene.hpp"

namespace terracut::baselines {
namespace {

struct HeightFieldOnScenes : testing::Test, test::BoxScene {
  HeightFieldMrf& segment(const test::BeamCast& beams, const HeightFieldMrf::Config& config = {}) {
    cast(beams);
    field.emplace(config, profile, kShape, image.return_capacity(), memory);
    report = field->segment(image);
    return *field;
  }
  std::optional<HeightFieldMrf> field;
  stage::SegmentationReport report;
};

TEST_F(HeightFieldOnScenes, FlatGroundIsAllGroundAndLevelWhereNothingIsSeen) {
  segment(test::flat_ground());
  EXPECT_EQ(report.ground, report.returns);
  for (const float range_m : {0.5F, 2.0F, 10.0F, 40.0F}) {
    EXPECT_NEAR(field->ground_m(100, range_m), 0, 0.11) << range_m;
  }
}

TEST_F(HeightFieldOnScenes, ASlopeIsFollowed) {
  segment(test::sloping_ground(0.08));
  EXPECT_NEAR(field->ground_m(0, 20.5F), 1.6, 0.15);     // ahead, uphill
  EXPECT_NEAR(field->ground_m(500, 10.5F), -0.8, 0.15);  // behind, downhill
  // Within the heights there are to choose from.
  const auto near = [](float x, float y, float) { return std::hypot(x, y) < 35; };
  EXPECT_GT(share(field->labels(), frame::Label::kGround, near), 0.99);
}

TEST_F(HeightFieldOnScenes, AWallIsAnObstacleOnLevelGround) {
  segment(test::ground_with_boxes({{12, 13, -4, 4, 0, 2}}));
  EXPECT_NEAR(field->ground_m(0, 12.2F), 0, 0.11);
  const auto wall = [](float, float, float z) { return z > 0.4F; };
  EXPECT_EQ(share(field->labels(), frame::Label::kObstacle, wall), 1.0);
  const auto road = [](float, float, float z) { return z < 0.01F; };
  EXPECT_EQ(share(field->labels(), frame::Label::kGround, road), 1.0);
}

TEST_F(HeightFieldOnScenes, TheRoofOfACarIsNotGroundBecauseTheRoadAroundItIs) {
  profile = test::even_profile(64, -40, -2, 4.0);
  const auto car = test::ground_with_boxes({{8, 12, -1, 1, 0, 1.5}}, 4.0);
  const auto roof = [](float x, float y, float z) {
    return x > 8.2F && x < 11.8F && std::fabs(y) < 0.9F && z > 1.45F;
  };
  segment(car);
  EXPECT_EQ(share(field->labels(), frame::Label::kObstacle, roof), 1.0);
  // It is the neighbours that say so: every cell by itself takes the roof for ground.
  HeightFieldMrf::Config alone;
  alone.iterations = 0;
  segment(car, alone);
  EXPECT_GT(share(field->labels(), frame::Label::kGround, roof), 0.4);
}

TEST_F(HeightFieldOnScenes, AWideTerraceIsGroundThoughItIsAStepUp) {
  // 20 m wide: more cells vouch for it than its edge costs.
  profile = test::even_profile(64, -40, -2, 4.0);
  segment(test::ground_with_boxes({{12, 60, -30, 30, 0, 1.2}}, 4.0));
  const auto terrace = [](float x, float y, float z) {
    return x > 16 && x < 30 && std::fabs(y) < 10 && z > 1.15F;
  };
  EXPECT_GT(share(field->labels(), frame::Label::kGround, terrace), 0.95);
}

TEST_F(HeightFieldOnScenes, NoGroundIsAboveABeamThatPassedThrough) {
  // A few returns hang in the air, where other beams of the same sector pass below to the road
  // behind. By itself the cell would take them for ground.
  const auto speck = [](double azimuth_rad, double elevation_rad) {
    const double d = test::flat_ground()(azimuth_rad, elevation_rad);
    const bool hit = azimuth_rad < 0.01 && elevation_rad > -0.05 && elevation_rad < -0.02;
    return hit ? 15.2 : d;
  };
  HeightFieldMrf::Config alone;
  alone.iterations = 0;
  segment(speck, alone);
  EXPECT_LT(field->ground_m(0, 15.3F), 0.35);
  alone.hidden_cost = 0;
  alone.above_cost = 0.1F;
  segment(speck, alone);
  EXPECT_LT(field->ground_m(0, 15.3F), 1.5);
}

TEST_F(HeightFieldOnScenes, HeightsBeyondTheListAreObstaclesOrGroundByTheNearestOne) {
  HeightFieldMrf::Config few;
  few.height_labels = 8;  // -0.4 .. 0.3 m
  segment(test::ground_with_boxes({{12, 13, -4, 4, 0, 3}}), few);
  const auto high = [](float, float, float z) { return z > 1.0F; };
  EXPECT_EQ(share(field->labels(), frame::Label::kObstacle, high), 1.0);
  EXPECT_EQ(share(field->labels(), frame::Label::kGround,
                  [](float, float, float z) { return z < 0.01F; }),
            1.0);
}

}  // namespace
}  // namespace terracut::baselines
