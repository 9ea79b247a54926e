// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/column_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/support/box_scene.hpp"

namespace terracut::baselines {
namespace {

struct ColumnAnglesOnScenes : testing::Test, test::BoxScene {
  ColumnAngles& segment(const test::BeamCast& beams, const ColumnAngles::Config& config = {}) {
    cast(beams);
    return again(config);
  }
  ColumnAngles& again(const ColumnAngles::Config& config = {}) {
    angles.emplace(config, profile, kShape, image.return_capacity(), memory);
    report = angles->segment(image);
    return *angles;
  }
  [[nodiscard]] static std::size_t cell(int row, int column) {
    return static_cast<std::size_t>(row * kShape.stride() + column);
  }
  std::optional<ColumnAngles> angles;
  stage::SegmentationReport report;
};

TEST_F(ColumnAnglesOnScenes, FlatGroundIsFlatAndAllGround) {
  segment(test::flat_ground());
  EXPECT_EQ(report.ground, report.returns);
  for (const int row : {0, 1, 20, 40}) EXPECT_NEAR(angles->angle_deg()[cell(row, 77)], 0, 0.01);
}

TEST_F(ColumnAnglesOnScenes, TheAngleOfASlopeIsItsInclination) {
  segment(test::sloping_ground(0.2));
  EXPECT_NEAR(angles->angle_deg()[cell(10, 0)], std::atan(0.2) * 180 / std::numbers::pi, 0.05);
  EXPECT_EQ(report.ground, report.returns);
}

TEST_F(ColumnAnglesOnScenes, AWallStandsAtNinetyDegreesAndIsAnObstacle) {
  segment(test::ground_with_boxes({{12, 12.5, -4, 4, 0, 2}}));
  const auto wall = [](float x, float, float z) { return x > 11.9F && x < 12.1F && z > 0.4F; };
  EXPECT_EQ(share(angles->labels(), frame::Label::kObstacle, wall), 1.0);
  const auto road = [](float x, float, float z) { return x < 9 && z < 0.01F; };
  EXPECT_EQ(share(angles->labels(), frame::Label::kGround, road), 1.0);
  int row = 0;
  while (image.z_m()[cell(row, 0)] < 1.0F) ++row;
  EXPECT_NEAR(angles->angle_deg()[cell(row, 0)], 90, 1.5);
}

TEST_F(ColumnAnglesOnScenes, TheRoofOfAVehicleIsTakenForGroundWhereAGentleWayLeadsUp) {
  // What the paper holds against the method. The ramp is a bonnet and windscreen of 4 degrees a
  // step; the roof at its end is as flat as a road.
  profile = test::even_profile(64, -40, -2, 4.0);
  const test::BeamCast ramp_to_roof = [](double azimuth_rad, double elevation_rad) {
    const double ground = test::flat_ground(4.0)(azimuth_rad, elevation_rad);
    double nearest = ground;
    for (int step = 0; step < 30; ++step) {  // a surface of ever steeper, then flatter, slats
      const double x = 8 + 0.1 * step;
      const double top = 0.75 * (1 - std::cos(std::numbers::pi * step / 30.0));
      nearest = std::min(
          nearest, test::distance_to({x, 14, -1, 1, 0, top}, azimuth_rad, elevation_rad, 4.0));
    }
    return nearest;
  };
  const auto roof = [](float x, float y, float z) {
    return x > 11.5F && x < 13.5F && std::fabs(y) < 0.9F && z > 1.4F;
  };
  ColumnAngles::Config loose;
  loose.same_ground_deg = 20;
  segment(ramp_to_roof, loose);
  EXPECT_GT(share(angles->labels(), frame::Label::kGround, roof), 0.9);
}

TEST_F(ColumnAnglesOnScenes, AFlatTopWithoutAWayUpIsNotReached) {
  profile = test::even_profile(64, -40, -2, 4.0);
  segment(test::ground_with_boxes({{8, 12, -1, 1, 0, 1.5}}, 4.0));
  const auto roof = [](float x, float y, float z) {
    return x > 9 && x < 11.0F && std::fabs(y) < 0.9F && z > 1.45F;
  };
  // Its sides are steps of nearly 90 degrees up the columns; along the rows the neighbours of the
  // roof are ground behind it, flat as well: they let it in. This is the calculation range that is
  // too small, of which the paper speaks.
  EXPECT_GT(share(angles->labels(), frame::Label::kGround, roof), 0.9);
}

TEST_F(ColumnAnglesOnScenes, GroundDoesNotStartOnAnythingSteep) {
  // The lowest beams meet a wall right ahead; nothing beside it is looked at.
  cast(test::ground_with_boxes({{3, 3.5, -40, 40, 0, 2}}));
  segment(test::ground_with_boxes({{3, 3.5, -40, 40, 0, 2}}));
  const auto ahead = [](float x, float, float z) { return x > 2.9F && x < 3.1F && z > 0.6F; };
  EXPECT_EQ(share(angles->labels(), frame::Label::kObstacle, ahead), 1.0);
}

TEST_F(ColumnAnglesOnScenes, AHoleIsBridgedBetweenNearRanges) {
  const auto holes = [](double azimuth_rad, double elevation_rad) {
    const double row = (elevation_rad * 180 / std::numbers::pi + 24) / 26 * 63;
    return std::lround(row) % 6 == 4 ? -1.0 : test::flat_ground()(azimuth_rad, elevation_rad);
  };
  segment(holes);
  EXPECT_FALSE(image.has_return(cell(10, 5)));
  EXPECT_NEAR(angles->angle_deg()[cell(10, 5)], 0, 0.01);
  ColumnAngles::Config none;
  none.repair_rows = 0;
  again(none);
  EXPECT_TRUE(std::isnan(angles->angle_deg()[cell(10, 5)]));
}

TEST_F(ColumnAnglesOnScenes, AMarginGrowsTheGround) {
  const auto wall = test::ground_with_boxes({{12, 12.5, -4, 4, 0, 2}});
  segment(wall);
  const std::uint32_t bare = report.ground;
  ColumnAngles::Config grown;
  grown.margin_rows = 2;
  segment(wall, grown);
  EXPECT_GT(report.ground, bare);
  EXPECT_LT(report.ground, report.returns);
}

TEST_F(ColumnAnglesOnScenes, TheSeamOfTheFrameIsNoEdge) {
  // The lowest ring sees nothing but one column left of the seam: ground has to cross it.
  ColumnAngles::Config config;
  const auto island = [](double azimuth_rad, double elevation_rad) {
    const double column = azimuth_rad / (2 * std::numbers::pi) * 1000;
    const bool near_seam = column < 5 || column > 994;
    return near_seam ? test::flat_ground()(azimuth_rad, elevation_rad) : -1.0;
  };
  config.start_deg = 45;
  segment(island, config);
  EXPECT_GT(report.returns, 300U);
  EXPECT_EQ(report.ground, report.returns);
}

}  // namespace
}  // namespace terracut::baselines
