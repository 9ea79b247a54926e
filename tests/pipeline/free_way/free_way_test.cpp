// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/free_way/free_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "pipeline/ground/segmenter.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::free_way {
namespace {

using frame::Label;

/// An open pit: its rectangle ahead and its depth below level ground.
struct Pit {
  double near_m, far_m, right_m, left_m, depth_m;
};

/// Level ground with a pit; a beam that enters it ends at its far walls or at its bottom.
test::BeamCast ground_with_pit(const Pit& pit, double height_m = 1.73) {
  return [=](double azimuth_rad, double elevation_rad) {
    const double ground_m = test::flat_ground(height_m)(azimuth_rad, elevation_rad);
    if (ground_m < 0) return ground_m;
    const double x = std::cos(elevation_rad) * std::cos(azimuth_rad);
    const double y = -std::cos(elevation_rad) * std::sin(azimuth_rad);
    const bool enters = ground_m * x > pit.near_m && ground_m * x < pit.far_m &&
                        ground_m * y > pit.right_m && ground_m * y < pit.left_m;
    if (!enters) return ground_m;
    const double to_wall_m = pit.far_m / x;
    const double to_side_m = y > 0 ? pit.left_m / y : y < 0 ? pit.right_m / y : INFINITY;
    const double to_bottom_m = (height_m + pit.depth_m) / std::sin(-elevation_rad);
    return std::min({to_wall_m, to_side_m, to_bottom_m});
  };
}

/// Adds noise of 1.5 cm to every beam and loses a share of them, the same ones each time.
test::BeamCast seen_by_a_sensor(test::BeamCast cast, std::uint64_t seed, double lost_share) {
  auto random = std::make_shared<world::Random>(seed);
  return [=](double azimuth_rad, double elevation_rad) {
    const double way_m = cast(azimuth_rad, elevation_rad) + 0.015 * random->normal();
    return random->chance(lost_share) ? -1.0 : way_m;
  };
}

/// A frame labelled by its heights: what is higher than 5 cm is an obstacle.
struct FreeWayOfAFrame : testing::Test, test::BoxScene {
  std::span<const Sector> find_in(const test::BeamCast& beams) {
    cast(beams);
    return find_again();
  }
  std::span<const Sector> find(const std::vector<test::Box>& boxes) {
    return find_in(test::ground_with_boxes(boxes));
  }
  std::span<const Sector> find_again() {
    labels.assign(image.returns(), Label::kNone);
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      planes.height_m[cell] = image.has_return(cell) ? image.z_m()[cell] : NAN;
      planes.label[cell] = Label::kNone;
      if (!image.has_return(cell)) continue;
      planes.label[cell] = image.z_m()[cell] > 0.05F ? Label::kObstacle : Label::kGround;
      labels[image.return_index()[cell]] = planes.label[cell];
    }
    free_way.find(image, planes, labels);
    return free_way.sectors();
  }
  /// The sector in a direction, degrees to the left.
  const Sector& towards(double left_deg) const {
    const double share = -left_deg / 360;
    const auto count = static_cast<double>(free_way.sectors().size());
    return free_way.sectors()[static_cast<std::size_t>((share - std::floor(share)) * count)];
  }

  stage::CellPlanes planes{kShape, memory};
  std::vector<Label> labels;
  FreeWay free_way{{}, profile, kShape, memory};
};

TEST_F(FreeWayOfAFrame, HasSectorsClockwiseFromStraightAhead) {
  EXPECT_EQ(free_way.sectors().size(), 720U);
  EXPECT_EQ(free_way.columns_of(0).begin, 0);
  EXPECT_EQ(free_way.columns_of(719).end, kShape.columns);
  EXPECT_NEAR(free_way.sectors()[0].azimuth_rad, 0, 0.01);
  EXPECT_NEAR(free_way.sectors()[180].azimuth_rad, -std::numbers::pi / 2, 0.01) << "to the right";
  EXPECT_NEAR(free_way.sectors()[540].azimuth_rad, std::numbers::pi / 2, 0.01) << "to the left";
  EXPECT_NEAR(free_way.seen_from_m(), 1.73 / std::tan(24 * std::numbers::pi / 180), 1e-3);
}

TEST_F(FreeWayOfAFrame, OnBareGroundEndsWhereRowsLieFartherApartThanTheGap) {
  const double step_rad = 26.0 / 63 * std::numbers::pi / 180;
  for (const Sector& sector : find({})) {
    EXPECT_TRUE(std::isinf(sector.obstacle_m));
    EXPECT_EQ(sector.seen_end, SeenEnd::kRows);
    const double next_m = 1.73 / std::tan(std::atan(1.73 / sector.seen_m) - step_rad);
    EXPECT_GT(next_m - sector.seen_m, 0.9);
    EXPECT_GT(sector.seen_m, 13);
    EXPECT_EQ(sector.free_m(), sector.seen_m);
  }
}

TEST_F(FreeWayOfAFrame, SeesAnObstacleAndNoGroundBehindIt) {
  find({{8, 9, 2, 3, 0, 1.5}});
  const Sector& there = towards(17);
  EXPECT_NEAR(there.obstacle_m, 8 / std::cos(17 * std::numbers::pi / 180), 0.05);
  EXPECT_LE(there.seen_m, there.obstacle_m);
  EXPECT_GT(there.seen_m, there.obstacle_m - 0.9);
  EXPECT_EQ(there.seen_end, SeenEnd::kObstacle);
  EXPECT_TRUE(std::isinf(towards(25).obstacle_m));
}

TEST_F(FreeWayOfAFrame, CountsObstaclesBetweenItsHeightsOnly) {
  find({{8, 9, 2, 3, 3.0, 4.0}, {8, 9, -3, -2, 0, 0.15}});
  EXPECT_TRUE(std::isinf(towards(17).obstacle_m)) << "a bridge";
  EXPECT_NEAR(towards(-17).obstacle_m, 8.4, 0.1) << "a kerb";
  FreeWay over_kerbs({.least_height_m = 0.2F}, profile, kShape, memory);
  over_kerbs.find(image, planes, labels);
  EXPECT_TRUE(std::isinf(over_kerbs.sectors()[34].obstacle_m)) << "a kerb for who drives over it";
  EXPECT_GT(towards(17).seen_m, 13);
  find({{8, 9, 2, 3, 2.0, 4.0}});
  EXPECT_NEAR(towards(17).obstacle_m, 8.4, 0.1) << "a lorry's body hangs that low";
}

TEST_F(FreeWayOfAFrame, SeesThePostThatIsOneColumnWide) {
  find({{10, 10.06, -0.06, 0, 0, 1.5}});
  EXPECT_NEAR(towards(-0.2).obstacle_m, 10, 0.1);
}

TEST_F(FreeWayOfAFrame, PassesOverSingleLostReturnsButNotOverBlackIce) {
  cast(test::flat_ground());
  frame::RangeImage whole(kShape, 1000, memory);
  test::cast_frame(profile, test::flat_ground(), whole);
  const auto without = [&](auto is_lost) {
    image.clear();
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const std::size_t cell = kShape.cell(row, column);
        if (!whole.has_return(cell) || is_lost(row, column, whole.ground_range_m()[cell])) continue;
        image.place(row, column,
                    {whole.x_m()[cell], whole.y_m()[cell], whole.z_m()[cell],
                     whole.ground_range_m()[cell], 0});
      }
    }
    return find_again();
  };
  const float far_m = find_again()[0].seen_m;
  without([](int, int column, float) { return column == 100; });
  for (const Sector& sector : free_way.sectors()) EXPECT_FLOAT_EQ(sector.seen_m, far_m);
  without([](int, int column, float range_m) {
    return column >= 100 && column < 110 && range_m > 8 && range_m < 9.5F;
  });
  EXPECT_NEAR(free_way.sectors()[75].seen_m, 8, 0.4);
  EXPECT_EQ(free_way.sectors()[75].seen_end, SeenEnd::kLost);
  EXPECT_FLOAT_EQ(free_way.sectors()[90].seen_m, far_m);
  without([](int, int, float) { return true; });
  EXPECT_EQ(free_way.sectors()[0].seen_m, 0);
  EXPECT_EQ(free_way.sectors()[0].seen_end, SeenEnd::kLost);
}

TEST_F(FreeWayOfAFrame, GoesOnDownASlopeAndEndsAtADrop) {
  const double crest_m = 6, slope = 0.15, height_m = 1.73;
  const auto down = [=](double azimuth_rad, double elevation_rad) {
    const double level_m = test::flat_ground(height_m)(azimuth_rad, elevation_rad);
    if (level_m < 0 || level_m * std::cos(elevation_rad) < crest_m) return level_m;
    const double beam_slope = std::tan(-elevation_rad) - slope;
    return beam_slope <= 0 ? -1
                           : (height_m - slope * crest_m) / beam_slope / std::cos(elevation_rad);
  };
  find_in(down);
  const float seen_m = towards(0).seen_m;
  EXPECT_GT(seen_m, 8);
  find_in([=](double azimuth_rad, double elevation_rad) {
    const double way_m = down(azimuth_rad, elevation_rad);
    const bool is_lost = std::abs(azimuth_rad) < 0.6 * 2 * std::numbers::pi / kShape.columns &&
                         way_m > 9 && way_m < 9.6;
    return is_lost ? -1 : way_m;
  });
  EXPECT_FLOAT_EQ(towards(0).seen_m, seen_m) << "what was lost lies as deep as what is beside it";
  find_in(ground_with_pit({4.5, 200, -100, 100, 0.3}));
  EXPECT_LE(towards(0).seen_m, 4.5);
  EXPECT_EQ(towards(0).seen_end, SeenEnd::kDrop);
}

TEST_F(FreeWayOfAFrame, TakesSecondReturnsOfACellToo) {
  cast(test::flat_ground());
  const int row = 30, column = 300;
  const std::size_t cell = kShape.cell(row, column);
  const float share = 0.8F;  // a leaf four fifths of the way to the ground
  ASSERT_TRUE(image.place(row, column,
                          {image.x_m()[cell] * share, image.y_m()[cell] * share, 0.35F,
                           image.ground_range_m()[cell] * share, 0}));
  find_again();
  labels[image.overflow()[0].return_index] = Label::kObstacle;
  free_way.find(image, planes, labels);
  EXPECT_FLOAT_EQ(free_way.sectors()[216].obstacle_m, image.ground_range_m()[cell] * share);
}

TEST_F(FreeWayOfAFrame, IsTheSameAgainAndAllocatesNothing) {
  const std::vector<test::Box> boxes{{12, 16, 3, 4.8, 0, 1.5}, {8, 8.1, -3, -2.9, 0, 2.5}};
  find(boxes);
  const std::vector<Sector> first(free_way.sectors().begin(), free_way.sectors().end());
  find({{20, 22, -3, 4, 0, 3}});
  find(boxes);
  EXPECT_TRUE(std::ranges::equal(first, free_way.sectors(), [](const Sector& a, const Sector& b) {
    return a.obstacle_m == b.obstacle_m && a.seen_m == b.seen_m && a.seen_end == b.seen_end;
  }));
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  const std::uint64_t before = test::allocations_of_this_thread();
  free_way.find(image, planes, labels);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

/// Sensors whose frames the method labels: rows from the lowest to the highest elevation.
struct Rows {
  int count;
  double lowest_deg, highest_deg;
};

struct FreeWayAtPits : testing::TestWithParam<Rows> {
  /// Casts and labels a frame, and returns how far ground was seen towards the pit: the most of any
  /// sector of which all columns cross it.
  float most_seen_over(const Pit& pit, std::uint64_t seed) {
    test::cast_frame(profile, seen_by_a_sensor(ground_with_pit(pit), seed, 0.005), image);
    (void)method.segment(image);
    free_way.find(image, method.planes(), method.labels());
    float most_m = -1;
    for (std::size_t i = 0; i < free_way.sectors().size(); ++i) {
      const frame::ColumnRange columns = free_way.columns_of(i);
      const auto crosses = [&](double column) {
        const double tangent = -std::tan(2 * std::numbers::pi * column / shape.columns);
        return std::cos(2 * std::numbers::pi * column / shape.columns) > 0 &&
               tangent * pit.near_m > pit.right_m && tangent * pit.near_m < pit.left_m &&
               tangent * pit.far_m > pit.right_m && tangent * pit.far_m < pit.left_m;
      };
      if (!crosses(columns.begin) || !crosses(columns.end)) continue;
      most_m = std::max(most_m, free_way.sectors()[i].seen_m);
    }
    return most_m;
  }

  frame::ImageShape shape{GetParam().count, 1800};
  mount::RingProfile profile =
      test::even_profile(GetParam().count, GetParam().lowest_deg, GetParam().highest_deg);
  memory::FixedMemory memory;
  frame::RangeImage image{shape, 1000, memory};
  ground::Segmenter method{{}, profile, shape, image.return_capacity(), memory};
  FreeWay free_way{{}, profile, shape, memory};
};

TEST_P(FreeWayAtPits, NeverRunsOverAnOpenOneOfOneMetreWithin20Metres) {
  constexpr double kDepths_m[] = {0.3, 0.5, 1.5, 30.0};
  std::uint64_t seed = 0;
  for (double near_m = free_way.seen_from_m(); near_m < 20; near_m += 0.1) {
    const double depth_m = kDepths_m[++seed % 4];
    const double aside_m = (static_cast<double>(seed % 5) - 2) * 0.2;
    const float seen_m =
        most_seen_over({near_m, near_m + 1, aside_m - 0.5, aside_m + 0.5, depth_m}, seed);
    ASSERT_GE(seen_m, 0) << "no sector lies in the pit whole";
    EXPECT_LT(seen_m, near_m + 0.1) << depth_m << " m deep";
  }
  EXPECT_GT(seed, 150U);
}

INSTANTIATE_TEST_SUITE_P(Sensors, FreeWayAtPits,
                         testing::Values(Rows{64, -24.9, 2.0}, Rows{32, -30.67, 10.67}),
                         [](const auto& sensor) {
                           return std::to_string(sensor.param.count) + "Rows";
                         });

}  // namespace
}  // namespace terracut::free_way
