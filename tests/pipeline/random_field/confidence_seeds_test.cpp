// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/random_field/confidence_seeds.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "tests/support/synthetic_frame.hpp"

namespace terracut::random_field {
namespace {

const frame::ImageShape kShape{8, 40};

struct LabelledPlanes : testing::Test {
  LabelledPlanes() : planes(kShape, memory) {
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        planes.label[at(row, column)] = frame::Label::kGround;
        planes.height_m[at(row, column)] = 0;
      }
    }
  }
  static std::size_t at(int row, int column) {
    return static_cast<std::size_t>(row * kShape.stride() + column);
  }
  std::span<const min_cut::Seed> select(const ConfidenceSeeds::Config& config = {}) {
    stage = std::make_unique<ConfidenceSeeds>(config, 0.25F, profile, kShape, memory);
    stage->select(planes, {0, kShape.columns});
    return stage->seeds();
  }
  memory::FixedMemory memory;
  stage::CellPlanes planes;
  mount::RingProfile profile = test::even_profile(kShape.rows, -20, 10);  // five of them see ground
  std::unique_ptr<ConfidenceSeeds> stage;
};

TEST_F(LabelledPlanes, GroundAmidGroundIsASeed) {
  const auto seeds = select();
  EXPECT_EQ(seeds[at(4, 20)], min_cut::Seed::kGround);
  EXPECT_EQ(seeds[at(0, 0)], min_cut::Seed::kGround);
}

TEST_F(LabelledPlanes, PaddingIsNoSeed) {
  EXPECT_EQ(select()[at(4, 40)], min_cut::Seed::kNone);
}

TEST_F(LabelledPlanes, GroundBesideObstaclesIsUnknownAlsoAcrossTheSeam) {
  for (int row = 0; row < kShape.rows; ++row) {
    for (const int column : {0, 1, 2}) {
      planes.label[at(row, column)] = frame::Label::kObstacle;
      planes.height_m[at(row, column)] = 1.0F;
    }
  }
  const auto seeds = select();
  EXPECT_EQ(seeds[at(4, 3)], min_cut::Seed::kUnknown);
  EXPECT_EQ(seeds[at(4, 39)], min_cut::Seed::kUnknown);
  EXPECT_EQ(seeds[at(4, 20)], min_cut::Seed::kGround);
  EXPECT_EQ(seeds[at(4, 0)], min_cut::Seed::kObstacle);
}

TEST_F(LabelledPlanes, EveryObstacleIsASeedHoweverLow) {
  planes.label[at(3, 9)] = frame::Label::kObstacle;
  planes.height_m[at(3, 9)] = 0.2F;
  EXPECT_EQ(select()[at(3, 9)], min_cut::Seed::kObstacle);
}

TEST_F(LabelledPlanes, RowsThatNeverSeeGroundKeepTheirLabelsIfAsked) {
  for (const int row : {1, 2, 3, 6, 7}) {
    for (const int column : {9, 10, 12, 13}) {
      planes.label[at(row, column)] = frame::Label::kObstacle;
    }
  }
  ConfidenceSeeds::Config config;
  config.rows = CutRows::kGround;
  const auto seeds = select(config);
  EXPECT_EQ(stage->cut_rows(), 5);
  EXPECT_EQ(seeds[at(7, 10)], min_cut::Seed::kObstacle);
  EXPECT_EQ(seeds[at(7, 11)], min_cut::Seed::kGround);
  EXPECT_EQ(seeds[at(2, 11)], min_cut::Seed::kUnknown);
  EXPECT_EQ(select()[at(7, 11)], min_cut::Seed::kUnknown) << "by default every row is decided";
}

struct SlidingWindow : LabelledPlanes, testing::WithParamInterface<ConfidenceSeeds::Config> {};
INSTANTIATE_TEST_SUITE_P(OfAnySize, SlidingWindow,
                         testing::Values(ConfidenceSeeds::Config{},
                                         // More returns than a byte counts.
                                         ConfidenceSeeds::Config{.ground_share = 0.75F,
                                                                 .window_rows = 8,
                                                                 .window_columns = 16}));

TEST_P(SlidingWindow, AgreesWithCountingEveryWindowPieceByPieceAndFrameAfterFrame) {
  const ConfidenceSeeds::Config config = GetParam();
  std::mt19937 random(3);
  int ground_seeds = 0, unknown = 0;
  for (int frame = 0; frame < 4; ++frame) {
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const auto fate = random() % 10;
        planes.label[at(row, column)] = fate < 2   ? frame::Label::kObstacle
                                        : fate < 4 ? frame::Label::kNone
                                                   : frame::Label::kGround;
      }
    }
    if (frame == 0) select(config);
    for (int begin = 0; begin < kShape.columns;) {
      const int end = std::min(kShape.columns, begin + 1 + static_cast<int>(random() % 40));
      stage->select(planes, {begin, end});
      begin = end;
    }
    const auto seeds = stage->seeds();
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        if (planes.label[at(row, column)] != frame::Label::kGround) continue;
        int ground = 0, returns = 0;
        const int last_row = std::min(kShape.rows - 1, row + config.window_rows);
        for (int r = std::max(0, row - config.window_rows); r <= last_row; ++r) {
          for (int c = column - config.window_columns; c <= column + config.window_columns; ++c) {
            const frame::Label label = planes.label[at(r, (c + kShape.columns) % kShape.columns)];
            ground += label == frame::Label::kGround;
            returns += label != frame::Label::kNone;
          }
        }
        const bool trusted =
            static_cast<float>(ground) > config.ground_share * static_cast<float>(returns);
        EXPECT_EQ(seeds[at(row, column)],
                  trusted ? min_cut::Seed::kGround : min_cut::Seed::kUnknown)
            << row << ", " << column << " of frame " << frame;
        ++(trusted ? ground_seeds : unknown);
      }
    }
  }
  EXPECT_GT(ground_seeds, 100);
  EXPECT_GT(unknown, 100);
}

}  // namespace
}  // namespace terracut::random_field
