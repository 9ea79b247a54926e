// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/visibility/sight_figures.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <initializer_list>

namespace terracut::visibility {
namespace {

constexpr Condition kCovered{State::kBlocked, Cause::kCovered};
constexpr Condition kSpray{State::kReduced, Cause::kAirborne};
constexpr Condition kFog{State::kReduced, Cause::kFog};

/// A learnt view of 30 m all around, clear but for some sectors.
struct FiguresOfAView : testing::Test {
  FiguresOfAView() {
    figures.has_learnt = 1;
    for (SightFigures::Sector& sector : figures.sectors) sector = {{}, 1, 30};
  }
  void set(std::initializer_list<std::size_t> sectors, Condition condition) {
    for (const std::size_t i : sectors) figures.sectors[i].condition = condition;
  }
  SightFigures figures;
};

TEST(DirectionOfASector, IsTheOneItsMiddleLiesIn) {
  EXPECT_EQ(direction_of(0), Direction::kAhead);
  EXPECT_EQ(direction_of(1), Direction::kAhead);
  EXPECT_EQ(direction_of(2), Direction::kAheadRight) << "25 degrees";
  EXPECT_EQ(direction_of(9), Direction::kRight);
  EXPECT_EQ(direction_of(18), Direction::kBehind);
  EXPECT_EQ(direction_of(27), Direction::kLeft);
  EXPECT_EQ(direction_of(33), Direction::kAheadLeft);
  EXPECT_EQ(direction_of(34), Direction::kAhead);
}

TEST_F(FiguresOfAView, SayInWordsWhatIsInTheWayAndWhere) {
  EXPECT_EQ(sight_text({}), "learning");
  EXPECT_EQ(sight_text(figures), "clear");
  set({33}, kCovered);
  EXPECT_EQ(sight_text(figures), "blocked, covered: 1 sector, ahead left");
  set({26, 27}, kCovered);
  EXPECT_EQ(sight_text(figures), "blocked, covered: 3 sectors, left and ahead left");
  set({0}, kSpray);
  EXPECT_EQ(sight_text(figures),
            "blocked, covered: 3 sectors, left and ahead left; reduced, airborne: 1 sector, ahead");
}

TEST_F(FiguresOfAView, NameDirectionsClockwiseAcrossStraightAhead) {
  set({32, 34, 0, 1, 2, 3}, kSpray);
  EXPECT_EQ(sight_text(figures), "reduced, airborne: 6 sectors, ahead left, ahead and ahead right");
}

TEST_F(FiguresOfAView, SayAllAroundWhereEverySectorWithAViewIsMeant) {
  for (std::size_t i = 0; i < 20; ++i) figures.sectors[i].condition = kFog;
  for (std::size_t i = 20; i < kSectors; ++i) figures.sectors[i].has_view = 0;
  EXPECT_EQ(sight_text(figures), "reduced, fog: all around");
}

TEST_F(FiguresOfAView, AreToldByDirection) {
  EXPECT_EQ(figures.worst(), Condition{});
  figures.sectors[34].visible_m = 5;
  figures.sectors[35].visible_m = 12;
  figures.sectors[17].visible_m = 5;
  set({1}, kSpray);
  const SightFigures::Of ahead = figures.in(Direction::kAhead);
  EXPECT_EQ(ahead.troubled, 1);
  EXPECT_EQ(ahead.with_view, 4);
  EXPECT_EQ(ahead.visible_m, 12) << "the lower of the two in the middle";
  EXPECT_EQ(figures.in(Direction::kBehind).visible_m, 30);
  set({9}, kCovered);
  EXPECT_EQ(figures.worst(), kCovered);
  EXPECT_EQ(figures.troubled_sectors(), 2);
  for (const std::size_t i : {34U, 35U, 0U, 1U}) figures.sectors[i].has_view = 0;
  EXPECT_EQ(figures.in(Direction::kAhead).with_view, 0);
  EXPECT_EQ(figures.in(Direction::kAhead).visible_m, 0);
}

TEST(FiguresOfAnotherProcess, MayBeAnything) {
  SightFigures figures;
  std::memset(static_cast<void*>(&figures), 0xFF, sizeof figures);
  EXPECT_GE(figures.worst().state, State::kCount);
  EXPECT_FALSE(sight_text(figures).empty());
  EXPECT_EQ(figures.in(Direction::kAhead).with_view, 4);
}

}  // namespace
}  // namespace terracut::visibility
