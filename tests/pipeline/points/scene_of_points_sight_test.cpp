// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "pipeline/points/frame_timing.hpp"
#include "pipeline/points/scene_of_points.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::points {
namespace {

using frame::Label;
using visibility::Cause;
using visibility::Direction;

/// Turns of 0.1 s of a sensor on level ground, as labelled points.
struct SightInPoints : testing::Test, test::BoxScene {
  SightInPoints() {
    cast(test::flat_ground());
    info.complete = true;
    info.head = {.first_turns = 0, .last_turns = 1};
    info.last_packet_ns = 100'000'000;
  }
  /// Looks at some turns. Columns of [from, to) return nothing; points lie where the vehicle saw
  /// them from where it is at the end of the turn, after it has driven `ahead_m`.
  void see(int turns, double ahead_m = 0, int from = 0, int to = 0) {
    points.clear();
    heights_m.clear();
    const FrameTiming timing = FrameTiming::of(info, beam_turns);
    for (int row = 0; row < kShape.rows; ++row) {
      const RowTimes times = RowTimes::of(row, kShape.columns, timing);
      for (int column = 0; column < kShape.columns; ++column) {
        const std::size_t cell = kShape.cell(row, column);
        if (!image.has_return(cell) || (column >= from && column < to)) continue;
        const float time_s = times.at(column);
        const auto moved_m = static_cast<float>(ahead_m * (1 - time_s / 0.1));
        points.push_back({image.x_m()[cell] - moved_m, image.y_m()[cell], image.z_m()[cell], 0,
                          Label::kGround, static_cast<std::uint16_t>(row), time_s});
        heights_m.push_back(image.z_m()[cell]);
      }
    }
    for (int i = 0; i < turns; ++i) scene.find(info, points, heights_m);
  }

  std::vector<float> beam_turns = std::vector<float>(kShape.rows, 0.01F);
  frame::FrameInfo info;
  std::vector<LabelledPoint> points;
  std::vector<float> heights_m;
  SceneOfPoints scene{{.sight = true}, profile, kShape, kShape.cells(), beam_turns};
};

TEST_F(SightInPoints, IsLearntAndThenClear) {
  EXPECT_EQ(scene.found().sight().is_watched, 1);
  EXPECT_EQ(scene.found().sight().has_learnt, 0);
  see(12);
  EXPECT_EQ(scene.found().sight().has_learnt, 1);
  EXPECT_EQ(scene.found().sight().worst(), visibility::Condition{});
  EXPECT_GT(scene.found().sight().in(Direction::kAhead).visible_m, 30);
}

TEST_F(SightInPoints, StaysClearHoweverFarDeskewedPointsAreMoved) {
  see(15);
  for (const double ahead_m : {0.5, 1.0, 2.0, 3.0, 4.0, 3.0, 1.0}) {
    see(5, ahead_m);
    EXPECT_EQ(scene.found().sight().worst(), visibility::Condition{}) << ahead_m;
    for (const auto& sector : scene.found().sight().sectors)
      EXPECT_GT(sector.visible_m, 30) << ahead_m;
  }
}

TEST_F(SightInPoints, IsBlockedWhereBeamsReturnNothing) {
  see(15, 2);
  see(5, 2, 250, 340);
  EXPECT_EQ(scene.found().sight().worst().cause, Cause::kCovered);
  EXPECT_EQ(scene.found().sight().in(Direction::kRight).troubled, 2) << "90 to 110 degrees";
  EXPECT_EQ(scene.found().sight().in(Direction::kLeft).troubled, 0);
}

TEST_F(SightInPoints, LeavesOutTurnsOfWhichPacketsAreMissing) {
  see(15);
  info.complete = false;
  see(8, 0, 250, 340);
  EXPECT_EQ(scene.found().sight().left_out_turns, 8U);
  EXPECT_EQ(scene.found().sight().worst(), visibility::Condition{});
}

TEST_F(SightInPoints, AllocatesNothingForATurn) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  see(12);
  const std::uint64_t before = test::allocations_of_this_thread();
  scene.find(info, points, heights_m);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::points
