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

const frame::ImageShape kShape{64, 960};  // no padding, and whole blocks of sectors
constexpr int kPacket = 6;                // columns
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

  /// Bits, so that NaN equals NaN.
  [[nodiscard]] std::vector<std::uint32_t> result() const {
    std::vector<std::uint32_t> bits;
    for (const float height_m : planes.height_m)
      bits.push_back(std::bit_cast<std::uint32_t>(height_m));
    for (const frame::Label label : planes.label) bits.push_back(static_cast<std::uint32_t>(label));
    for (const std::uint8_t steep : planes.steep) bits.push_back(steep);
    return bits;
  }

  memory::FixedMemory memory;
  mount::RingProfile profile = test::even_profile();
  stage::CellPlanes planes;
  CoarseStages stages;
};

/// A frame whose columns arrive one after the other.
struct ArrivingColumns {
  explicit ArrivingColumns(const test::BeamCast& cast)
      : whole(kShape, 0, memory), image(kShape, kOverflow, memory) {
    test::cast_frame(test::even_profile(), cast, whole);
    image.clear();
  }
  void place(int column) {
    for (int row = 0; row < kShape.rows; ++row) place(row, column);
  }
  void place(int row, int column) {
    const std::size_t cell = kShape.cell(row, column);
    if (!whole.has_return(cell)) return;
    ASSERT_TRUE(image.place(row, column,
                            {whole.x_m()[cell], whole.y_m()[cell], whole.z_m()[cell],
                             whole.ground_range_m()[cell], 0}));
  }
  memory::FixedMemory memory;
  frame::RangeImage whole;
  frame::RangeImage image;
};

struct Recorder : stage::StageObserver {
  void stage_done(stage::Stage stage) noexcept override {
    ++parts;
    last = stage;
  }
  int parts = 0;
  stage::Stage last = stage::Stage::kCount;
};

struct CoarseStagesOfArrivingFrames : testing::TestWithParam<const char*> {
  static SegmenterConfig config() {
    SegmenterConfig config =
        std::string_view(GetParam()) == "paper" ? paper_profile() : terracut_profile();
    if (std::string_view(GetParam()) == "elevation")
      config.last_stage = stage::Stage::kElevationMap;
    return config;
  }
  /// What the stages make of the image as it is now, nothing done ahead.
  static std::vector<std::uint32_t> at_once(const frame::RangeImage& image) {
    Way way(config());
    way.stages.finish(image, way.planes);
    return way.result();
  }
  /// Ends the frame: its planes are those of the whole image at once, and what the rules say.
  void expect_right_labels(const frame::RangeImage& image) {
    way.stages.finish(image, way.planes);
    EXPECT_EQ(way.result(), at_once(image));

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
  /// Lets the frame arrive; `meanwhile(column)` is called after each packet.
  template <class Meanwhile>
  void arrive(ArrivingColumns& frame, Meanwhile meanwhile) {
    for (int column = 0; column < kShape.columns; ++column) {
      frame.place(column);
      if ((column + 1) % kPacket != 0) continue;
      way.stages.advance(frame.image, column + 1, way.planes, &recorder);
      meanwhile(column);
    }
  }
  void arrive(ArrivingColumns& frame) {
    arrive(frame, [](int) {});
  }
  Way way{config()};
  Recorder recorder;
};

TEST_P(CoarseStagesOfArrivingFrames, LabelAsIfTheFrameHadComeAtOnce) {
  ArrivingColumns frame(hills_and_walls());
  arrive(frame);
  const bool has_surface = std::string_view(GetParam()) != "paper";
  EXPECT_GE(way.stages.share_ahead(frame.image), has_surface ? 0.4F : 1.0F);
  EXPECT_GE(recorder.parts, 4);
  expect_right_labels(frame.image);
  EXPECT_GT(std::ranges::count(way.planes.label, frame::Label::kObstacle), 1000);
  EXPECT_GT(std::ranges::count(way.planes.label, frame::Label::kGround), 1000);
}

TEST_P(CoarseStagesOfArrivingFrames, LabelAsIfAtOnceHoweverFarTheFrameHadCome) {
  ArrivingColumns frame(hills_and_walls());
  for (int column = 0; column < kShape.columns; ++column) frame.place(column);
  const auto expected = at_once(frame.image);
  for (const int complete : {0, 1, 159, 160, 161, 320, 500, 777, 950, 959, 960}) {
    way.stages.advance(frame.image, complete, way.planes);
    way.stages.finish(frame.image, way.planes);
    EXPECT_EQ(way.result(), expected) << complete << " columns complete";
  }
}

TEST_P(CoarseStagesOfArrivingFrames, LabelAnythingAsIfAtOnce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range_m(0.5, 119);
  for (int trial = 0; trial < 5; ++trial) {
    ArrivingColumns frame([&](double, double) { return range_m(random); });
    arrive(frame);
    expect_right_labels(frame.image);
  }
}

TEST_P(CoarseStagesOfArrivingFrames, LabelStripsOfAllWidthsWhoseGroundIsLostOnTheWay) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 25; ++trial) {
    SCOPED_TRACE(trial);
    ArrivingColumns frame(strips_behind_ditches(random));
    arrive(frame);
    expect_right_labels(frame.image);
  }
}

TEST_P(CoarseStagesOfArrivingFrames, CompareAcrossTheSeamBothWays) {
  // Two returns in a column each, nothing else near: a step up of 0.5 m over 5 cm.
  const int reach = config().adjacent_points.column_reach;
  for (int before = 1; before <= reach; ++before) {
    for (int after = 0; before + after <= reach; ++after) {
      for (const bool lower_is_before : {false, true}) {
        SCOPED_TRACE(testing::Message() << before << " before, " << after << " after the seam");
        ArrivingColumns frame(test::flat_ground());
        const int last = kShape.columns - before;
        for (int column = 0; column < kShape.columns; ++column) {
          if (column > 20 && column < kShape.columns - 20) frame.place(column);
          constexpr int kRow = 20;
          if (column != after && column != last) continue;
          const bool is_lower = (column == last) == lower_is_before;
          ASSERT_TRUE(frame.image.place(
              kRow + (is_lower ? 0 : 2), column,
              {is_lower ? 6.0F : 6.05F, 0, is_lower ? 0.0F : 0.5F, is_lower ? 6.0F : 6.05F, 0}));
          way.stages.advance(frame.image, column + 1, way.planes);
        }
        expect_right_labels(frame.image);
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

TEST_P(CoarseStagesOfArrivingFrames, MarkAWallBesideTheSeamAsEverywhere) {
  // Straight ahead and low: its returns are obstacles by the steps between them alone.
  ArrivingColumns frame(test::ground_with_wall(8, 0.4, 0.14));
  arrive(frame);
  expect_right_labels(frame.image);
}

TEST_P(CoarseStagesOfArrivingFrames, SeeNothingInEmptyCellsWhateverTheFrameBeforeLeftThere) {
  // Every eighth row comes back in the second frame, on ground with bumps. Left over below each of
  // its returns are those of the first one, 2 m deeper.
  constexpr int kApart = 8;
  ArrivingColumns frame(test::flat_ground());
  const auto place = [&](int row, int column, float z_m) {
    const std::size_t above = kShape.cell((row + kApart - 1) / kApart * kApart, column);
    if (above >= kShape.cells() || !frame.whole.has_return(above)) return;
    ASSERT_TRUE(frame.image.place(row, column,
                                  {frame.whole.x_m()[above], frame.whole.y_m()[above], z_m,
                                   frame.whole.ground_range_m()[above], 0}));
  };
  for (int row = 0; row < kShape.rows; ++row) {
    for (int column = 0; column < kShape.columns; ++column) place(row, column, -2.0F);
  }
  way.stages.finish(frame.image, way.planes);
  frame.image.clear();
  for (int column = 0; column < kShape.columns; ++column) {
    for (int row = 0; row < kShape.rows; row += kApart) {
      place(row, column, column % 2 == 0 ? 0.0F : 0.08F);
    }
    way.stages.advance(frame.image, column + 1, way.planes);
  }
  expect_right_labels(frame.image);
  EXPECT_EQ(std::ranges::count(way.planes.label, frame::Label::kObstacle), 0);
}

TEST_P(CoarseStagesOfArrivingFrames, GiveGroundAcrossTheSeamFromEitherSide) {
  // Rising ground, hidden by walls over more sectors than ground is interpolated over, on one side
  // of the seam; above the walls something on poles is seen.
  for (const bool is_hidden_before : {false, true}) {
    ArrivingColumns frame([&](double azimuth_rad, double elevation_rad) {
      const double share = azimuth_rad / (2 * std::numbers::pi);
      const bool is_hidden = is_hidden_before ? share > 0.8 : share < 0.2;
      const double down = 0.03 - std::tan(elevation_rad);
      const double range_m = 1.73 / down;
      if (!is_hidden || (range_m > 0 && range_m < 6)) return range_m / std::cos(elevation_rad);
      return (elevation_rad < -0.02 ? 6.0 : 30.0) / std::cos(elevation_rad);
    });
    arrive(frame);
    expect_right_labels(frame.image);
  }
}

TEST_P(CoarseStagesOfArrivingFrames, TakeAReturnThatComesAfterItsColumnWasDone) {
  ArrivingColumns frame(hills_and_walls());
  const std::size_t late = kShape.cell(20, 100);
  ASSERT_TRUE(frame.whole.has_return(late));
  for (int column = 0; column < kShape.columns; ++column) {
    for (int row = 0; row < kShape.rows; ++row) {
      if (kShape.cell(row, column) != late) frame.place(row, column);
    }
    way.stages.advance(frame.image, column + 1, way.planes, &recorder);
    if (column == 800) frame.place(20, 100);
  }
  expect_right_labels(frame.image);
}

TEST_P(CoarseStagesOfArrivingFrames, TakeASecondReturnThatComesAfterItsColumnWasDone) {
  struct Late {
    frame::CellOwner owner;
    int column;
  };
  // Into a sector that was done long ago, and into that traced last.
  for (const Late& late :
       {Late{frame::CellOwner::kFirstArrived, 100}, Late{frame::CellOwner::kNearest, 100},
        Late{frame::CellOwner::kFirstArrived, 795}}) {
    ArrivingColumns frame(hills_and_walls());
    arrive(frame, [&](int column) {
      if (column != 803) return;
      int returns = 0;
      for (const int row : {5, 20, 30, 40}) {
        const std::size_t cell = kShape.cell(row, late.column);
        if (!frame.image.has_return(cell)) continue;
        // Lower and nearer than what is there: it changes the ground of its sector.
        const float share = 0.8F;
        ASSERT_TRUE(frame.image.place(
            row, late.column,
            {share * frame.image.x_m()[cell], share * frame.image.y_m()[cell],
             frame.image.z_m()[cell] - 0.3F, share * frame.image.ground_range_m()[cell], 0},
            late.owner));
        ++returns;
      }
      EXPECT_GT(returns, 2);
    });
    expect_right_labels(frame.image);
  }
}

TEST_P(CoarseStagesOfArrivingFrames, TakeSecondReturnsInTheirOwnTime) {
  ArrivingColumns frame(hills_and_walls());
  int returns = 0;
  for (int column = 0; column < kShape.columns; ++column) {
    frame.place(column);
    for (int row = 3; row < 40; row += 20) {
      const std::size_t cell = kShape.cell(row, column);
      if (!frame.image.has_return(cell)) continue;
      ASSERT_TRUE(frame.image.place(
          row, column,
          {frame.image.x_m()[cell], frame.image.y_m()[cell], frame.image.z_m()[cell] - 0.4F,
           frame.image.ground_range_m()[cell], 0}));
      ++returns;
    }
    way.stages.advance(frame.image, column + 1, way.planes, &recorder);
  }
  EXPECT_GT(returns, 500);
  const int ahead = recorder.parts;
  way.stages.finish(frame.image, way.planes, &recorder);
  EXPECT_LT(recorder.parts - ahead, ahead) << "most was done ahead, not again";
  EXPECT_EQ(way.result(), at_once(frame.image));
}

TEST_P(CoarseStagesOfArrivingFrames, ResetAFrameThatNeverBecameWhole) {
  ArrivingColumns first(hills_and_walls()), second(test::ground_with_wall(12, 4, 2.0));
  arrive(first);
  arrive(second);
  expect_right_labels(second.image);

  way.stages.advance(first.image, 900, way.planes);
  first.image.clear();  // its next frame
  for (int column = 0; column < 700; ++column) first.place(column);
  way.stages.advance(first.image, 600, way.planes);
  expect_right_labels(first.image);
}

TEST_P(CoarseStagesOfArrivingFrames, DoNothingForAFrameWithoutReturns) {
  ArrivingColumns frame([](double, double) { return -1.0; });
  arrive(frame);
  EXPECT_EQ(recorder.parts, 0);
  expect_right_labels(frame.image);
}

TEST_P(CoarseStagesOfArrivingFrames, AllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  ArrivingColumns frame(hills_and_walls());
  const std::uint64_t before = test::allocations_of_this_thread();
  arrive(frame);
  way.stages.finish(frame.image, way.planes);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

INSTANTIATE_TEST_SUITE_P(Profiles, CoarseStagesOfArrivingFrames,
                         testing::Values("terracut", "paper", "elevation"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace terracut::ground
