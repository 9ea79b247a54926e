// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/visibility/sight_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/box_scene.hpp"

namespace terracut::visibility {
namespace {

using frame::Label;

/// Turns of a sensor on level ground, of which beams between two azimuths can be covered.
struct WatchOfASensor : testing::Test, test::BoxScene {
  void see(SightWatch& watch, int turns, double covered_from_deg = 0, double covered_to_deg = 0) {
    const test::BeamCast field = test::flat_ground();
    cast([=](double azimuth_rad, double elevation_rad) {
      const double azimuth_deg = azimuth_rad * 180 / std::numbers::pi;
      const bool is_covered = azimuth_deg >= covered_from_deg && azimuth_deg < covered_to_deg;
      return is_covered ? -1 : field(azimuth_rad, elevation_rad);
    });
    for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
      planes.height_m[cell] = image.has_return(cell) ? image.z_m()[cell] : NAN;
      planes.label[cell] = image.has_return(cell) ? Label::kGround : Label::kNone;
    }
    for (int i = 0; i < turns; ++i) watch.look(image, planes, true);
  }
  static std::uint64_t turns_by(const SightWatch& watch, Cause cause) {
    return watch.figures().turns[static_cast<std::size_t>(cause)];
  }

  stage::CellPlanes planes{kShape, memory};
};

TEST_F(WatchOfASensor, TellsEachTurnOnce) {
  SightWatch watch(profile, kShape, memory);
  EXPECT_EQ(watch.figures().is_watched, 1);
  see(watch, 12);
  EXPECT_EQ(watch.figures().has_learnt, 1);
  EXPECT_EQ(watch.figures().learning_turns, 10U);
  EXPECT_EQ(turns_by(watch, Cause::kNone), 2U);
  see(watch, 5, 90, 120);
  EXPECT_EQ(turns_by(watch, Cause::kNone), 5U);
  EXPECT_EQ(turns_by(watch, Cause::kCovered), 2U);
  EXPECT_EQ(watch.figures().in(Direction::kRight).troubled, 2);
  EXPECT_EQ(watch.figures().in(Direction::kLeft).troubled, 0);
  EXPECT_GT(watch.figures().sectors[20].visible_m, 30);
}

TEST_F(WatchOfASensor, TellsWhereTheSensorNeverSawAnything) {
  SightWatch watch(profile, kShape, memory);
  see(watch, 12, 90, 120);
  const auto blind =
      std::ranges::count(watch.figures().sectors, 0, &SightFigures::Sector::has_view);
  EXPECT_GE(blind, 1);
  EXPECT_LT(blind, kSectors / 4);
}

TEST_F(WatchOfASensor, TakesATurnForWholeThatLacksATenthOfItsFirings) {
  const auto is_whole = [](bool complete, std::uint64_t holes) {
    frame::FrameInfo info;
    info.complete = complete;
    info.losses.azimuth_hole_columns = holes;
    return SightWatch::is_whole(info, kShape);
  };
  EXPECT_TRUE(is_whole(true, 0));
  EXPECT_TRUE(is_whole(false, 100));
  EXPECT_FALSE(is_whole(false, 101));
  EXPECT_FALSE(is_whole(false, 0)) << "the first turn, of which nobody knows what is missing";
}

TEST_F(WatchOfASensor, LeavesOutTurnsOfWhichPacketsAreMissing) {
  SightWatch watch(profile, kShape, memory);
  see(watch, 12);
  image.clear();
  for (int i = 0; i < 20; ++i) watch.look(image, planes, false);
  EXPECT_EQ(watch.figures().left_out_turns, 20U);
  EXPECT_EQ(watch.figures().worst(), Condition{});
  see(watch, 1);
  EXPECT_EQ(watch.figures().worst(), Condition{});
}

TEST_F(WatchOfASensor, TellsTheVehiclesDirectionsOfASensorUpsideDown) {
  profile.mount.roll_rad = std::numbers::pi;
  SightWatch watch(profile, kShape, memory);
  see(watch, 12);
  see(watch, 5, 90, 120);
  EXPECT_EQ(watch.figures().in(Direction::kRight).troubled, 0);
  EXPECT_EQ(watch.figures().in(Direction::kLeft).troubled, 2);
}

}  // namespace
}  // namespace terracut::visibility
