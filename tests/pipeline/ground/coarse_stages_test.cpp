// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/coarse_stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "plain_coarse_labels.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::ground {
namespace {

const frame::ImageShape kShape{64, 960};  // 96 sectors, no padding
constexpr int kSectors = 96;
constexpr std::size_t kOverflow = 2000;

/// Walls of all kinds around the vehicle, roofs in a row among them, on hilly ground; some beams
/// come back from nowhere.
test::BeamCast hills_and_walls() {
  return [](double azimuth_rad, double elevation_rad) {
    if (std::sin(37 * azimuth_rad + 91 * elevation_rad) > 0.97) return -1.0;
    const double wall_m = 9 + 4 * std::sin(7 * azimuth_rad) + 2 * std::sin(31 * azimuth_rad);
    const double wall_top_m = 0.4 + 0.9 * std::fabs(std::sin(11 * azimuth_rad));
    const double slope = 0.12 * std::sin(3 * azimuth_rad);
    const double down = -std::sin(elevation_rad) + slope * std::cos(elevation_rad);
    const double ground_m = down > 0.004 ? 1.73 / down : -1;
    const double hit_z_m = 1.73 + wall_m * std::tan(elevation_rad);
    const bool hits = std::sin(5 * azimuth_rad) > -0.2 && hit_z_m < wall_top_m + slope * wall_m &&
                      (ground_m < 0 || wall_m < ground_m);
    return hits ? wall_m / std::cos(elevation_rad) : ground_m;
  };
}

/// Level ground that ends in a ditch, here nearer and there farther away, and begins again behind
/// it lower, higher or inclined: on strips of all widths, so that some are too narrow to be ground.
/// Beams that meet something before they get there, and beams that come back from nowhere.
test::BeamCast strips_behind_ditches(std::mt19937& random) {
  struct Strip {
    double end_rad, ditch_m, far_side_m, height_m, slope;
  };
  const auto between = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  std::vector<Strip> strips;
  for (double end_rad = 0; end_rad < 2 * std::numbers::pi;) {
    end_rad += between(0.05, 0.6);
    const double ditch_m = between(6, 14), wide_m = between(0.3, 5);
    strips.push_back(
        {end_rad, ditch_m, ditch_m + wide_m, between(-0.5, 0.5) * wide_m, between(-0.5, 0.2)});
  }
  const double first_rad = between(0, 2 * std::numbers::pi);  // some strip lies across the seam
  return [strips, first_rad, &random](double azimuth_rad, double elevation_rad) {
    azimuth_rad = std::fmod(azimuth_rad + first_rad, 2 * std::numbers::pi);
    const double fate = std::uniform_real_distribution<double>(0, 1)(random);
    if (fate < 0.1) return -1.0;
    const auto strip = std::ranges::find_if(
        strips, [azimuth_rad](const Strip& s) { return azimuth_rad < s.end_rad; });
    const double down = -std::tan(elevation_rad);
    double range_m = 1.73 / down;
    if (!(range_m > 0 && range_m < strip->ditch_m)) {
      // Where the beam meets the line of the far side.
      range_m = (1.73 - strip->height_m + strip->slope * strip->far_side_m) / (down + strip->slope);
      if (!(range_m > strip->far_side_m)) return -1.0;
    }
    const double nearer = fate > 0.8 ? 1 - 0.4 * (fate - 0.8) : 1;
    return nearer * range_m / std::cos(elevation_rad);
  };
}

/// One way through the coarse stages, with all its memory.
struct Way {
  explicit Way(const SegmenterConfig& config)
      : planes(kShape, memory), stages(config, profile, kShape, memory) {}

  /// Labels an image by itself, all columns at once.
  void label(const frame::RangeImage& image) {
    stages.begin();
    for (const frame::OverflowReturn& extra : image.overflow()) {
      stages.take_extra(static_cast<int>(extra.cell) % kShape.stride(), extra.point.z_m,
                        extra.point.ground_range_m);
    }
    stages.take_to(kSectors, image.points());
    stages.label_circle(image.points(), planes);
  }
  /// What was found in a cell, as bits, so that NaN equals NaN.
  [[nodiscard]] std::uint64_t found(std::size_t cell) const {
    return std::uint64_t{std::bit_cast<std::uint32_t>(planes.height_m[cell])} << 32U |
           static_cast<std::uint64_t>(planes.label[cell]) << 8U | planes.steep[cell];
  }

  memory::FixedMemory memory;
  mount::RingProfile profile = test::even_profile();
  stage::CellPlanes planes;
  CoarseStages stages;
};

struct CastFrame {
  explicit CastFrame(const test::BeamCast& cast) : image(kShape, kOverflow, memory) {
    test::cast_frame(test::even_profile(), cast, image);
  }
  memory::FixedMemory memory;
  frame::RangeImage image;
};

/// The points of turn after turn, each in place of the one before.
struct RingOfPoints {
  std::vector<float> x_m = std::vector<float>(kShape.cells());
  std::vector<float> y_m = x_m, z_m = x_m, range_m = x_m;

  void take(const frame::RangeImage& image, int column) {
    for (int row = 0; row < kShape.rows; ++row) {
      const std::size_t cell = kShape.cell(row, column);
      x_m[cell] = image.x_m()[cell];
      y_m[cell] = image.y_m()[cell];
      z_m[cell] = image.z_m()[cell];
      range_m[cell] = image.ground_range_m()[cell];
    }
  }
  [[nodiscard]] frame::PointPlanes planes() const {
    return {x_m.data(), y_m.data(), z_m.data(), range_m.data()};
  }
};

struct Recorder : stage::StageObserver {
  void stage_done(stage::Stage stage) noexcept override { last = stage; }
  stage::Stage last = stage::Stage::kCount;
};

struct CoarseStagesOf : testing::TestWithParam<const char*> {
  static SegmenterConfig config() {
    SegmenterConfig config =
        std::string_view(GetParam()) == "paper" ? paper_profile() : terracut_profile();
    if (std::string_view(GetParam()) == "elevation")
      config.last_stage = stage::Stage::kElevationMap;
    return config;
  }
  /// Labels an image by itself; its planes are what the rules say.
  void expect_right_labels(const frame::RangeImage& image) {
    way.label(image);
    memory::FixedMemory memory;
    const elevation::RingGrid grid(config().elevation_map.grid, way.profile, kShape, memory);
    const test::PlainCoarseLabels plain(config(), way.profile, grid, image);
    const double obstacle_height_m = double{config().elevation_map.obstacle_height_m};
    constexpr double kSlack_m = 1e-3;
    int wrong_heights = 0, wrong_steps = 0, wrong_labels = 0;
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      const frame::Label label = way.planes.label[cell];
      if (!image.has_return(cell)) {
        wrong_labels += label != frame::Label::kNone;
        wrong_heights += !std::isnan(way.planes.height_m[cell]);
        continue;
      }
      const double height_m = plain.height_m[cell];
      wrong_heights += !(std::fabs(double{way.planes.height_m[cell]} - height_m) < kSlack_m);
      bool is_steep = false;
      if (config().last_stage >= stage::Stage::kAdjacentPoints) {
        is_steep = (way.planes.steep[cell] & stage::kSteep) != 0;
        const bool matters = height_m <= obstacle_height_m - kSlack_m;
        wrong_steps += is_steep ? !plain.may_be_steep[cell] : plain.must_be_steep[cell] && matters;
      }
      const double above_m = std::fmax(height_m, plain.stands_out_m[cell]);
      const bool may_be_ground = !is_steep && above_m < obstacle_height_m + kSlack_m;
      const bool may_be_obstacle = is_steep || above_m > obstacle_height_m - kSlack_m;
      wrong_labels += !(label == frame::Label::kGround && may_be_ground) &&
                      !(label == frame::Label::kObstacle && may_be_obstacle);
    }
    EXPECT_EQ(wrong_heights, 0);
    EXPECT_EQ(wrong_steps, 0);
    EXPECT_EQ(wrong_labels, 0);
  }
  Way way{config()};
  Recorder recorder;
};

TEST_P(CoarseStagesOf, OneTurnLabelItByTheRules) {
  const CastFrame frame(hills_and_walls());
  expect_right_labels(frame.image);
  EXPECT_GT(std::ranges::count(way.planes.label, frame::Label::kObstacle), 1000);
  EXPECT_GT(std::ranges::count(way.planes.label, frame::Label::kGround), 1000);
}

TEST_P(CoarseStagesOf, OneTurnLabelAnythingByTheRules) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range_m(0.5, 119);
  for (int trial = 0; trial < 5; ++trial) {
    expect_right_labels(CastFrame([&](double, double) { return range_m(random); }).image);
  }
}

TEST_P(CoarseStagesOf, OneTurnLabelStripsOfAllWidthsWhoseGroundIsLostOnTheWay) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 25; ++trial) {
    SCOPED_TRACE(trial);
    expect_right_labels(CastFrame(strips_behind_ditches(random)).image);
  }
}

TEST_P(CoarseStagesOf, OneTurnCompareAcrossTheSeamBothWays) {
  // Two returns in a column each, nothing else near: a step up of 0.5 m over 5 cm.
  const CastFrame ground(test::flat_ground());
  const int reach = config().adjacent_points.column_reach;
  for (int before = 1; before <= reach; ++before) {
    for (int after = 0; before + after <= reach; ++after) {
      for (const bool lower_is_before : {false, true}) {
        SCOPED_TRACE(testing::Message() << before << " before, " << after << " after the seam");
        memory::FixedMemory memory;
        frame::RangeImage image(kShape, 0, memory);
        const int last = kShape.columns - before;
        for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
          const int column = static_cast<int>(cell) % kShape.stride();
          if (column <= 20 || column >= kShape.columns - 20 || !ground.image.has_return(cell))
            continue;
          ASSERT_TRUE(
              image.place(static_cast<int>(cell) / kShape.stride(), column,
                          {ground.image.x_m()[cell], ground.image.y_m()[cell],
                           ground.image.z_m()[cell], ground.image.ground_range_m()[cell], 0}));
        }
        for (const int column : {after, last}) {
          constexpr int kRow = 20;
          const bool is_lower = (column == last) == lower_is_before;
          ASSERT_TRUE(image.place(
              kRow + (is_lower ? 0 : 2), column,
              {is_lower ? 6.0F : 6.05F, 0, is_lower ? 0.0F : 0.5F, is_lower ? 6.0F : 6.05F, 0}));
        }
        expect_right_labels(image);
        const std::size_t upper = kShape.cell(22, lower_is_before ? after : last);
        EXPECT_EQ(way.planes.label[upper], frame::Label::kObstacle);
        const bool matters = way.planes.height_m[upper] <= config().elevation_map.obstacle_height_m;
        const bool is_told = config().last_stage >= stage::Stage::kAdjacentPoints &&
                             (matters || std::string_view(GetParam()) == "paper");
        EXPECT_EQ(way.planes.steep[upper] & stage::kSteep, is_told);
      }
    }
  }
}

TEST_P(CoarseStagesOf, OneTurnMarkAWallBesideTheSeamAsEverywhere) {
  // Straight ahead and low: its returns are obstacles by the steps between them alone.
  expect_right_labels(CastFrame(test::ground_with_wall(8, 0.4, 0.14)).image);
}

TEST_P(CoarseStagesOf, OneTurnGiveGroundAcrossTheSeamFromEitherSide) {
  // Rising ground, hidden by walls over more sectors than ground is interpolated over, on one side
  // of the seam; above the walls something on poles is seen.
  for (const bool is_hidden_before : {false, true}) {
    expect_right_labels(CastFrame([&](double azimuth_rad, double elevation_rad) {
                          const double share = azimuth_rad / (2 * std::numbers::pi);
                          const bool is_hidden = is_hidden_before ? share > 0.8 : share < 0.2;
                          const double down = 0.03 - std::tan(elevation_rad);
                          const double range_m = 1.73 / down;
                          if (!is_hidden || (range_m > 0 && range_m < 6)) {
                            return range_m / std::cos(elevation_rad);
                          }
                          return (elevation_rad < -0.02 ? 6.0 : 30.0) / std::cos(elevation_rad);
                        }).image);
  }
}

TEST_P(CoarseStagesOf, OneTurnTakeSecondReturnsIntoAccount) {
  CastFrame frame(hills_and_walls());
  for (int column = 0; column < kShape.columns; ++column) {
    for (int row = 3; row < 40; row += 20) {
      const std::size_t cell = kShape.cell(row, column);
      if (!frame.image.has_return(cell)) continue;
      ASSERT_TRUE(frame.image.place(
          row, column,
          {frame.image.x_m()[cell], frame.image.y_m()[cell], frame.image.z_m()[cell] - 0.4F,
           frame.image.ground_range_m()[cell], 0}));
    }
  }
  EXPECT_GT(frame.image.overflow().size(), 500U);
  expect_right_labels(frame.image);
}

TEST_P(CoarseStagesOf, TurnAfterTurnOfAStillWorldLabelEachAsOneTurn) {
  if (!way.stages.can_go_on()) GTEST_SKIP() << "each turn is labelled by itself";
  std::mt19937 random(3);
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(trial);
    const CastFrame frame(trial % 2 == 0 ? strips_behind_ditches(random) : hills_and_walls());
    Way once(config());
    once.label(frame.image);
    RingOfPoints ring;
    for (int column = 0; column < kShape.columns; ++column) ring.take(frame.image, column);
    way.stages.begin();
    way.stages.take_to(kSectors, ring.planes());
    way.stages.label_circle(ring.planes(), way.planes);
    for (int turn = 1; turn < 4; ++turn) {
      way.stages.begin_next_turn();
      // What this turn labels is there no more.
      int compared = way.stages.labelled_columns();
      for (int sector = 0; sector < kSectors;) {
        const int end = std::min(sector + 1 + static_cast<int>(random() % 12U), kSectors);
        for (int column = 10 * sector; column < 10 * end; ++column) {
          ring.take(frame.image, column);
        }
        way.stages.take_to(end, ring.planes());
        way.stages.label(ring.planes(), way.planes, &recorder);
        for (; compared < way.stages.labelled_columns(); ++compared) {
          for (int row = 0; row < kShape.rows; ++row) {
            const std::size_t cell =
                kShape.cell(row, compared < 0 ? compared + kShape.columns : compared);
            ASSERT_EQ(way.found(cell), once.found(cell)) << "column " << compared;
            way.planes.label[cell] = frame::Label::kNone;
            way.planes.height_m[cell] = 100;
          }
        }
        sector = end;
      }
      EXPECT_GE(way.stages.labelled_columns(), kShape.columns - 151);
    }
  }
}

TEST_P(CoarseStagesOf, TurnAfterTurnLabelTheEndOfTheLastAsItsBeginningFollowed) {
  if (!way.stages.can_go_on()) GTEST_SKIP() << "each turn is labelled by itself";
  const CastFrame frame(hills_and_walls());
  Way once(config());
  once.label(frame.image);
  way.label(frame.image);
  way.stages.begin_next_turn();
  way.stages.take_to(kSectors, frame.image.points());
  way.stages.label(frame.image.points(), way.planes);
  EXPECT_LT(way.stages.labelled_columns(), kShape.columns - 100);
  way.stages.label_circle(frame.image.points(), way.planes);
  EXPECT_GE(way.stages.labelled_columns(), kShape.columns - 1);
  for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
    const int column = static_cast<int>(cell) % kShape.stride();
    if (column == kShape.columns - 1) continue;  // not compared with the first column
    ASSERT_EQ(way.found(cell), once.found(cell)) << column;
  }
}

TEST_P(CoarseStagesOf, TurnsSeeNothingOfATurnBeforeThatNoOtherFollowed) {
  const CastFrame first(hills_and_walls()), second(test::ground_with_wall(12, 4, 2.0));
  way.label(first.image);
  way.stages.begin_next_turn();
  way.stages.take_to(kSectors / 2, first.image.points());
  expect_right_labels(second.image);
}

TEST_P(CoarseStagesOf, OneTurnWithoutReturnsGiveNoLabel) {
  expect_right_labels(CastFrame([](double, double) { return -1.0; }).image);
}

TEST_P(CoarseStagesOf, TurnsAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  const CastFrame frame(hills_and_walls());
  const std::uint64_t before = test::allocations_of_this_thread();
  way.label(frame.image);
  way.stages.begin_next_turn();
  way.stages.take_to(kSectors, frame.image.points());
  way.stages.label(frame.image.points(), way.planes);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

INSTANTIATE_TEST_SUITE_P(Profiles, CoarseStagesOf,
                         testing::Values("terracut", "paper", "elevation"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace terracut::ground
