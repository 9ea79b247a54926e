// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/segmenter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::ground {
namespace {

const frame::ImageShape kShape{64, 1000};

struct SegmenterOnSyntheticFrames : testing::Test {
  SegmenterOnSyntheticFrames() : image(kShape, 1000, memory) {}
  std::span<const frame::Label> segment(const test::BeamCast& cast,
                                        const SegmenterConfig& config = {}) {
    test::cast_frame(profile, cast, image);
    return resegment(config);
  }
  /// What the stages before the cut say, under the defaults otherwise.
  std::vector<frame::Label> coarse_labels(const test::BeamCast& cast) {
    SegmenterConfig coarse;
    coarse.last_stage = stage::Stage::kAdjacentPoints;
    const auto labels = segment(cast, coarse);
    return {labels.begin(), labels.end()};
  }
  std::span<const frame::Label> resegment(const SegmenterConfig& config = {}) {
    segmenter =
        std::make_unique<Segmenter>(config, profile, kShape, image.return_capacity(), memory);
    report = segmenter->segment(image);
    return segmenter->labels();
  }
  /// Share of the returns above `from_m` and below `to_m` that carry `label`.
  double share(frame::Label label, float from_m, float to_m) {
    int all = 0, hits = 0;
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      if (!image.has_return(cell) || image.z_m()[cell] < from_m || image.z_m()[cell] >= to_m)
        continue;
      ++all;
      hits += segmenter->labels()[image.return_index()[cell]] == label;
    }
    return all == 0 ? -1.0 : static_cast<double>(hits) / all;
  }
  memory::FixedMemory memory;
  mount::RingProfile profile = test::even_profile();
  frame::RangeImage image;
  std::unique_ptr<Segmenter> segmenter;
  stage::SegmentationReport report;
};

TEST_F(SegmenterOnSyntheticFrames, FlatGroundIsAllGroundInBothProfiles) {
  for (const auto& config : {terracut_profile(), paper_profile()}) {
    const auto labels = segment(test::flat_ground(), config);
    EXPECT_GT(labels.size(), 50'000U);
    EXPECT_TRUE(std::all_of(labels.begin(), labels.end(),
                            [](frame::Label l) { return l == frame::Label::kGround; }));
    EXPECT_EQ(report.ground, labels.size());
  }
}

TEST_F(SegmenterOnSyntheticFrames, AWallStandsOutOfTheGroundInBothProfiles) {
  for (const auto& config : {terracut_profile(), paper_profile()}) {
    segment(test::ground_with_wall(12, 4, 2.0), config);
    EXPECT_EQ(share(frame::Label::kObstacle, 0.3F, 3.0F), 1.0);
    EXPECT_GT(share(frame::Label::kGround, -0.5F, 0.02F), 0.99);
  }
}

TEST_F(SegmenterOnSyntheticFrames, TheLowEdgeOfAnObstacleIsPulledToItByTheCut) {
  // The wall's returns between 5 and 12 cm are no higher than road bumps; their neighbours decide.
  segment(test::ground_with_wall(9, 4, 1.5, 0.05));
  EXPECT_GT(share(frame::Label::kObstacle, 0.05F, 0.12F), 0.95);
}

TEST_F(SegmenterOnSyntheticFrames, EveryReturnIsLabelledThoseOfTakenCellsIncluded) {
  test::cast_frame(profile, test::ground_with_wall(12, 4, 2.0), image);
  for (int column = 0; column < 500; ++column) {
    // Second returns: half of them on the ground, half high above it.
    const float x = 10 + 0.01F * static_cast<float>(column);
    ASSERT_TRUE(image.place(20, column, {0, -x, column % 2 == 0 ? 0.0F : 1.0F, x, 0}));
  }
  const auto labels = resegment();
  ASSERT_EQ(labels.size(), image.returns());
  EXPECT_EQ(report.returns, image.returns());
  EXPECT_EQ(std::count(labels.begin(), labels.end(), frame::Label::kNone), 0);
  for (const frame::OverflowReturn& extra : image.overflow()) {
    const frame::Label expected =
        extra.point.z_m > 0.5F ? frame::Label::kObstacle : frame::Label::kGround;
    EXPECT_EQ(labels[extra.return_index], expected);
  }
}

TEST_F(SegmenterOnSyntheticFrames, EveryStageCanBeTheLast) {
  SegmenterConfig config;
  for (const stage::Stage last :
       {stage::Stage::kElevationMap, stage::Stage::kAdjacentPoints, stage::Stage::kMinCut}) {
    config.last_stage = last;
    segment(test::ground_with_wall(12, 4, 2.0), config);
    EXPECT_EQ(share(frame::Label::kObstacle, 0.3F, 3.0F), 1.0) << stage::to_string(last);
    EXPECT_EQ(report.cut.unknown > 0, last == stage::Stage::kMinCut);
  }
}

TEST_F(SegmenterOnSyntheticFrames, ABudgetThatHasExpiredLeavesTheLabelsOfTheStagesBefore) {
  const std::vector<frame::Label> expected = coarse_labels(test::ground_with_wall(9, 4, 1.5, 0.05));
  segmenter = std::make_unique<Segmenter>(SegmenterConfig{}, profile, kShape,
                                          image.return_capacity(), memory);
  min_cut::CutBudget expired;
  expired.expired = [](void*) noexcept { return true; };
  report = segmenter->segment(image, expired);
  EXPECT_EQ(report.last_stage, stage::Stage::kAdjacentPoints);
  EXPECT_EQ(report.cut.unknown, 0U);
  const auto labels = segmenter->labels();
  EXPECT_TRUE(std::equal(labels.begin(), labels.end(), expected.begin(), expected.end()));
  EXPECT_EQ(segmenter->segment(image).last_stage, stage::Stage::kMinCut);
}

TEST_F(SegmenterOnSyntheticFrames, ACutStoppedTooSoonLeavesTheLabelsOfTheStagesBefore) {
  const std::vector<frame::Label> expected = coarse_labels(test::ground_with_wall(9, 4, 1.5, 0.05));
  segmenter = std::make_unique<Segmenter>(SegmenterConfig{}, profile, kShape,
                                          image.return_capacity(), memory);
  int looks = 0;
  min_cut::CutBudget from_the_second_look;  // the first one comes before the seeds
  from_the_second_look.context = &looks;
  from_the_second_look.expired = [](void* so_far) noexcept {
    return ++*static_cast<int*>(so_far) > 1;
  };
  report = segmenter->segment(image, from_the_second_look);
  EXPECT_TRUE(report.cut.discarded);
  EXPECT_GT(report.cut.coarse_by_budget, 0U);
  EXPECT_EQ(report.last_stage, stage::Stage::kAdjacentPoints);
  const auto labels = segmenter->labels();
  EXPECT_TRUE(std::equal(labels.begin(), labels.end(), expected.begin(), expected.end()));
}

TEST_F(SegmenterOnSyntheticFrames, AnEmptyFrameHasNoLabels) {
  EXPECT_TRUE(segment([](double, double) { return -1.0; }).empty());
  EXPECT_TRUE(segment([](double, double) { return -1.0; }, paper_profile()).empty());
}

TEST_F(SegmenterOnSyntheticFrames, NoiseOfAnyKindGetsALabelForEveryReturn) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> range_m(0.5, 119);
  for (const auto& config : {terracut_profile(), paper_profile()}) {
    const auto labels = segment([&](double, double) { return range_m(random); }, config);
    EXPECT_EQ(labels.size(), kShape.rows * static_cast<std::size_t>(kShape.columns));
    EXPECT_EQ(std::count(labels.begin(), labels.end(), frame::Label::kNone), 0);
  }
}

TEST_F(SegmenterOnSyntheticFrames, TheSameFrameGivesTheSameLabelsWhateverCameBefore) {
  const auto wall = test::ground_with_wall(12, 4, 2.0);
  const auto first_view = segment(wall);
  const std::vector<frame::Label> first(first_view.begin(), first_view.end());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range_m(0.5, 119);
  test::cast_frame(profile, [&](double, double) { return range_m(random); }, image);
  (void)segmenter->segment(image);
  test::cast_frame(profile, wall, image);
  (void)segmenter->segment(image);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), segmenter->labels().begin(),
                         segmenter->labels().end()));
}

TEST_F(SegmenterOnSyntheticFrames, RotatingTheWorldRotatesTheLabels) {
  // By whole sectors, so that the ring grid sees the same cells in other places.
  const auto cast = test::ground_with_wall(12, 4, 2.0);
  const double rotation_rad = 2 * std::numbers::pi * 100 / kShape.columns;
  segment(cast);
  std::vector<frame::Label> labels(kShape.cells(), frame::Label::kNone);
  std::copy(segmenter->planes().label.begin(), segmenter->planes().label.end(), labels.begin());
  segment(
      [&](double azimuth, double elevation) { return cast(azimuth - rotation_rad, elevation); });
  int different = 0;
  for (int row = 0; row < kShape.rows; ++row) {
    for (int column = 0; column < kShape.columns; ++column) {
      const auto first = static_cast<std::size_t>(row * kShape.stride());
      const auto rotated = static_cast<std::size_t>((column + 100) % kShape.columns);
      different += labels[first + static_cast<std::size_t>(column)] !=
                   segmenter->planes().label[first + rotated];
    }
  }
  EXPECT_LE(different, 5) << "rounding may move a return at the very edge of the wall";
}

SegmenterConfig with_heights(SegmenterConfig config = terracut_profile()) {
  config.gives_heights = true;
  return config;
}

TEST_F(SegmenterOnSyntheticFrames, EveryReturnHasItsHeightAboveLevelGround) {
  // In the paper's, a cell that shows a wall alone has its foot for ground.
  for (const auto& [config, most_m] :
       {std::pair{terracut_profile(), 0.03F}, std::pair{paper_profile(), 0.05F}}) {
    segment(test::ground_with_wall(12, 4, 2.0), with_heights(config));
    const std::span<const float> heights_m = segmenter->heights_m();
    ASSERT_EQ(heights_m.size(), image.returns());
    float worst_m = 0;
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      if (!image.has_return(cell)) continue;
      const float height_m = heights_m[image.return_index()[cell]];
      worst_m = std::max(worst_m, std::fabs(height_m - image.z_m()[cell]));
    }
    EXPECT_LT(worst_m, most_m);
  }
}

TEST_F(SegmenterOnSyntheticFrames, HeightsAreAboveTheGroundWhereItSlopes) {
  // A road that rises by 6 m in 100 m, and a wall across it.
  constexpr double kSlope = 0.06, kWall_m = 15, kSensor_m = 1.73;
  segment(
      [](double azimuth_rad, double elevation_rad) {
        const double forward = std::cos(elevation_rad) * std::cos(azimuth_rad);
        const double sinks = kSlope * forward - std::sin(elevation_rad);
        const double ground = sinks > 0 ? kSensor_m / sinks : -1.0;
        const double wall = forward > 0 ? kWall_m / forward : 1e9;
        const double above_m = kSensor_m + wall * std::sin(elevation_rad) - kSlope * wall * forward;
        return (ground < 0 || wall < ground) && above_m < 2 ? wall : ground;
      },
      with_heights());
  // The ground below the wall is as it was seen before the wall, and so a little too low.
  int on_wall = 0, on_ground = 0;
  double off_on_wall_m = 0, off_on_ground_m = 0;
  for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
    if (!image.has_return(cell) || image.ground_range_m()[cell] > 20) continue;
    const float above_m = image.z_m()[cell] - static_cast<float>(kSlope) * image.x_m()[cell];
    const float off_m = std::fabs(segmenter->heights_m()[image.return_index()[cell]] - above_m);
    ASSERT_LT(off_m, 0.15F) << image.x_m()[cell] << " " << image.y_m()[cell];
    const bool is_on_wall = above_m > 0.01F;
    ++(is_on_wall ? on_wall : on_ground);
    (is_on_wall ? off_on_wall_m : off_on_ground_m) += off_m;
  }
  EXPECT_GT(on_wall, 500);
  EXPECT_GT(on_ground, 10'000);
  EXPECT_LT(off_on_wall_m / on_wall, 0.08);
  EXPECT_LT(off_on_ground_m / on_ground, 0.02);
}

TEST_F(SegmenterOnSyntheticFrames, AReturnOfATakenCellHasItsOwnHeight) {
  test::cast_frame(profile, test::flat_ground(), image);
  for (int column = 0; column < 500; ++column) {
    ASSERT_TRUE(image.place(20, column, {0, -10, column % 2 == 0 ? 0.01F : 1.0F, 10, 0}));
  }
  resegment(with_heights());
  ASSERT_EQ(segmenter->heights_m().size(), image.returns());
  for (const frame::OverflowReturn& extra : image.overflow()) {
    EXPECT_NEAR(segmenter->heights_m()[extra.return_index], extra.point.z_m, 0.03F);
  }
}

TEST_F(SegmenterOnSyntheticFrames, HeightsChangeNoLabelAndAreThereOnlyWhereTheyAreAskedFor) {
  const auto wall = test::ground_with_wall(9, 4, 1.5, 0.05);
  const auto view = segment(wall);
  const std::vector<frame::Label> without(view.begin(), view.end());
  EXPECT_FALSE(segmenter->gives_heights());
  EXPECT_TRUE(segmenter->heights_m().empty());
  const auto with = segment(wall, with_heights());
  EXPECT_TRUE(segmenter->gives_heights());
  EXPECT_TRUE(std::ranges::equal(with, without));
}

TEST_F(SegmenterOnSyntheticFrames, NothingIsAllocatedPerFrame) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  segment(test::ground_with_wall(12, 4, 2.0), with_heights());
  const std::uint64_t before = test::allocations_of_this_thread();
  for (int frame = 0; frame < 3; ++frame) (void)segmenter->segment(image);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

TEST_F(SegmenterOnSyntheticFrames, ReportsStagesToTheObserverInTheirOrder) {
  struct Recorder : stage::StageObserver {
    void stage_done(stage::Stage stage) noexcept override {
      if (std::ranges::find(seen, stage) == seen.end()) seen.push_back(stage);
    }
    std::vector<stage::Stage> seen;  // the coarse ones are done in parts
  } recorder;
  segment(test::flat_ground());
  (void)segmenter->segment(image, {}, &recorder);
  EXPECT_EQ(recorder.seen,
            (std::vector<stage::Stage>{stage::Stage::kElevationMap, stage::Stage::kAdjacentPoints,
                                       stage::Stage::kSeeds, stage::Stage::kMinCut,
                                       stage::Stage::kLabels}));
}

}  // namespace
}  // namespace terracut::ground
