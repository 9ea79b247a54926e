// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/adjacent_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "pipeline/ground/coarse_stages.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::elevation {
namespace {

const frame::ImageShape kShape{64, 360};
constexpr float kNoLimit_m = 1e9F;

AdjacentPoints::Config paper_rule() {
  AdjacentPoints::Config config;
  config.rule = AdjacentRule::kRingSpacing;
  config.max_slope_rad = 0.25F;
  config.first_row_step = config.last_row_step = 2;
  config.column_reach = 3;
  return config;
}

/// Heights and labels of the stage before, then the stage itself.
struct Refined {
  Refined(const AdjacentPoints::Config& config, const test::BeamCast& cast)
      : profile(test::even_profile()), image(kShape, 16, memory), planes(kShape, memory) {
    ground::SegmenterConfig stages;
    stages.elevation_map = {};
    stages.adjacent_points = config;
    stages.elevation_map.obstacle_height_m = kNoLimit_m;  // whatever is steep is wanted
    test::cast_frame(profile, cast, image);
    ground::CoarseStages coarse(stages, profile, kShape, memory);
    coarse.begin();
    coarse.take_to(coarse.grid().sectors(), image.points());
    coarse.label_circle(image.points(), planes);
  }
  [[nodiscard]] int steep_cells() const {
    int count = 0;
    for (const auto s : planes.steep) count += s & stage::kSteep;
    return count;
  }
  memory::FixedMemory memory;
  mount::RingProfile profile;
  frame::RangeImage image;
  stage::CellPlanes planes;
};

TEST(AdjacentPoints, BoundIsEquationFive) {
  // h = 2 m, of which the upper laser sits 0.2 m above the sensor's origin; beams 60 and 65 degrees
  // from the downward normal, K = 0.25 rad: 2 (tan 65 - tan 60) / (tan 0.25 tan 65 + 1) = 2
  // (2.144507 - 1.732051) / (0.255342 * 2.144507 + 1)
  mount::RingProfile profile;
  profile.mount.height_m = 1.8;
  for (const double elevation_deg : {-30.0, -27.0, -25.0}) {
    mount::Ring ring;
    ring.elevation_rad = elevation_deg * std::numbers::pi / 180;
    ring.ground_distance_m = 2.0 / std::tan(-ring.elevation_rad);
    ring.origin_height_m = elevation_deg > -26 ? 0.2 : 0;
    profile.rings.push_back(ring);
  }
  memory::FixedMemory memory;
  const AdjacentPoints stage(paper_rule(), kNoLimit_m, profile, {3, 360}, memory);
  EXPECT_NEAR(stage.ring_spacing_m(0, 2), 0.533030, 1e-5);
}

TEST(AdjacentPoints, PairsWhoseUpperBeamMissesTheGroundHaveNoBound) {
  memory::FixedMemory memory;
  const AdjacentPoints stage(paper_rule(), kNoLimit_m, test::even_profile(), kShape, memory);
  EXPECT_GT(stage.ring_spacing_m(10, 2), 0.0F);
  EXPECT_EQ(stage.ring_spacing_m(61, 2), 0.0F);
}

TEST(AdjacentPoints, FlatGroundHasNoSteepStepByEitherRule) {
  EXPECT_EQ(Refined({}, test::flat_ground()).steep_cells(), 0);
  EXPECT_EQ(Refined(paper_rule(), test::flat_ground()).steep_cells(), 0);
}

TEST(AdjacentPoints, AWallIsSteepByEitherRule) {
  for (const auto& config : {AdjacentPoints::Config{}, paper_rule()}) {
    const Refined wall(config, test::ground_with_wall(10, 3, 1.5));
    int wall_cells = 0, found = 0;
    for (std::size_t cell = 0; cell < wall.planes.steep.size(); ++cell) {
      if (!wall.image.has_return(cell) || wall.image.z_m()[cell] < 0.5F) continue;
      ++wall_cells;
      found += wall.planes.steep[cell] & stage::kSteep;
      EXPECT_TRUE((wall.planes.steep[cell] & stage::kSteep) == 0 ||
                  wall.planes.label[cell] == frame::Label::kObstacle);
    }
    EXPECT_GT(wall_cells, 100);
    EXPECT_EQ(found, wall_cells);
  }
}

TEST(AdjacentPoints, SeesAWallThatLiesAcrossTheSeamOfColumns) {
  const Refined wall({}, test::ground_with_wall(10, 2, 1.0));       // straight ahead is the seam
  const auto row = static_cast<std::size_t>(kShape.stride()) * 40;  // 7.5 deg down: on the wall
  ASSERT_NEAR(wall.image.x_m()[row], 10.0F, 0.01F);
  EXPECT_EQ(wall.planes.steep[row] & stage::kSteep, 1);
  EXPECT_EQ(wall.planes.steep[row + 359] & stage::kSteep, 1);
}

TEST(AdjacentPoints, EmptyCellsAreNeverSteep) {
  const Refined sky({}, [](double, double) { return -1.0; });
  EXPECT_EQ(sky.steep_cells(), 0);
}

/// What kSlope marks, pair by pair: kSteep of each cell.
std::vector<std::uint8_t> steep_one_by_one(const AdjacentPoints::Config& config, float max_height_m,
                                           frame::ImageShape shape,
                                           const frame::PointPlanes& points,
                                           std::span<const float> height_m) {
  std::vector<std::uint8_t> steep(shape.cells());
  const auto tan_max_slope_squared =
      static_cast<float>(std::pow(std::tan(static_cast<double>(config.max_slope_rad)), 2));
  for (int row = 0; row + 1 < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      for (int offset = -config.column_reach; offset <= config.column_reach; ++offset) {
        const std::size_t low = shape.cell(row, column);
        const std::size_t up =
            shape.cell(row + 1, (column + offset + shape.columns) % shape.columns);
        const float dx = points.x_m[up] - points.x_m[low], dy = points.y_m[up] - points.y_m[low];
        const float rise = points.z_m[up] - points.z_m[low];
        if (!(rise >= config.min_rise_m) ||
            !((dx * dx + dy * dy) * tan_max_slope_squared < rise * rise) ||
            !(height_m[up] >= config.min_upper_height_m)) {
          continue;
        }
        if (height_m[up] <= max_height_m) steep[up] = stage::kSteep;
        if (height_m[low] >= config.min_lower_height_m && height_m[low] <= max_height_m) {
          steep[low] = stage::kSteep;
        }
      }
    }
  }
  return steep;
}

TEST(AdjacentPoints, ComparesColumnsTogetherAsIfOneByOne) {
  std::minstd_rand random(1);
  int found = 0;
  const auto metres = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 1000U) / 1000.0F;
  };
  for (const int columns : {20, 33, 40, 67, 130}) {
    for (const int reach : {0, 1, 8}) {
      AdjacentPoints::Config config;
      config.last_row_step = 1;
      config.column_reach = reach;
      constexpr float kMaxHeight_m = 0.3F;
      const frame::ImageShape shape{8, columns};
      memory::FixedMemory memory;
      stage::CellPlanes planes(shape, memory);
      std::vector<float> x_m(shape.cells()), y_m(shape.cells()), z_m(shape.cells());
      const frame::PointPlanes points{x_m.data(), y_m.data(), z_m.data(), nullptr};
      for (int row = 0; row < shape.rows; ++row) {
        for (int column = 0; column < columns; ++column) {
          const std::size_t cell = shape.cell(row, column);
          x_m[cell] = metres(10, 11);
          y_m[cell] = metres(0, 1);
          // Pieces of ground, of walls, and without a return, so that some can be left out.
          const auto kind = random() % 20U;
          const bool as_before = column > 0 && kind != 0;
          const float before_m = as_before ? planes.height_m[cell - 1] : metres(-0.1F, 0.5F);
          z_m[cell] = planes.height_m[cell] =
              !as_before && random() % 4U == 0 ? std::nanf("") : before_m + metres(-0.02F, 0.02F);
        }
      }
      AdjacentPoints stage(config, kMaxHeight_m, test::even_profile(8), shape, memory);
      stage.reset({0, columns}, planes);
      for (int begin = 0; begin < columns;) {
        const int end = std::min(columns, begin + 1 + static_cast<int>(random() % 70U));
        stage.compare(points, {begin, end}, planes);
        begin = end;
      }
      stage.compare_across_seam(points, planes);
      const auto expected = steep_one_by_one(config, kMaxHeight_m, shape, points, planes.height_m);
      for (std::size_t cell = 0; cell < expected.size(); ++cell) {
        EXPECT_EQ(planes.steep[cell] & stage::kSteep, expected[cell]) << columns << " " << reach;
        found += expected[cell];
      }
    }
  }
  EXPECT_GT(found, 400);
}

}  // namespace
}  // namespace terracut::elevation
