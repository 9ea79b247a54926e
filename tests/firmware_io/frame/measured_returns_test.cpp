// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/measured_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "firmware_io/frame/point_ring.hpp"
#include "tests/firmware_io/frame/plain_tiles.hpp"

namespace terracut::frame {
namespace {

constexpr ImageShape kShape{8, 200};
using Measured = test::PlainTile;
using test::PlainReader;

struct MeasuredReturnsTest : testing::Test {
  std::uint32_t add(const Measured& tile, CellOwner owner = CellOwner::kFirstArrived,
                    std::int32_t first_column = 0) {
    return tile.add_to(returns, reader, owner, first_column);
  }
  /// x of the return that owns a cell of laser 2's row; 0: none.
  float owner_in(int column) {
    PointRing points(kShape, std::make_unique<PlainReader>(), memory);
    points.begin_turn();
    points.make_until(kShape.columns, returns, [](int, float, float) {});
    const std::size_t cell = kShape.cell(5, column);
    return std::isnan(points.planes().z_m[cell]) ? 0 : points.planes().x_m[cell];
  }
  /// Ranges of the returns in all columns that own no cell.
  std::vector<float> extras() {
    std::vector<float> found;
    PointRing points(kShape, std::make_unique<PlainReader>(), memory);
    points.begin_turn();
    points.make_until(kShape.columns, returns,
                      [&](int, float, float range_m) { found.push_back(range_m); });
    return found;
  }

  memory::FixedMemory memory;
  MeasuredReturns returns{kShape, test::kPlainLasers, 4, memory};
  PlainReader reader;
};

TEST_F(MeasuredReturnsTest, AreNumberedFiringByFiringLaserByLaser) {
  Measured tile(10);
  tile.raw[0][0] = tile.raw[3][0] = tile.raw[1][5] = tile.raw[7][23] = 100;
  EXPECT_EQ(add(tile), 0U);
  ASSERT_EQ(returns.tiles(), 1U);
  EXPECT_EQ(returns.returns(), 4U);
  EXPECT_EQ(returns.tile(0).first_return[0], 0U);
  EXPECT_EQ(returns.tile(0).first_return[1], 2U);
  EXPECT_EQ(returns.tile(0).first_return[5], 2U);
  EXPECT_EQ(returns.tile(0).first_return[6], 3U);
  EXPECT_EQ(returns.row(0, 1).returns, 1U << 5);
  EXPECT_TRUE(returns.row(0, 1).is_run);
  add(tile = Measured(40));
  EXPECT_EQ(returns.tiles(), 1U) << "a tile without a return is none";
}

TEST_F(MeasuredReturnsTest, OfAnotherFrameAreLeftOut) {
  Measured tile(190);  // columns 190 .. 213, of which 200 is the next frame's first
  tile.raw[2].fill(50);
  EXPECT_EQ(add(tile), 0U);
  EXPECT_EQ(returns.returns(), 10U);
  EXPECT_EQ(returns.row(0, 2).owned, (1U << 10) - 1);
  returns.clear(1);
  EXPECT_EQ(add(tile, CellOwner::kFirstArrived, kShape.columns), 0U);
  EXPECT_EQ(returns.returns(), 14U);
  EXPECT_EQ(returns.column(0, 2, 10), 0);
  EXPECT_EQ(returns.column(0, 2, 23), 13);
}

TEST_F(MeasuredReturnsTest, OfALaserThatIsAheadOfTheOthersMayAllBeOfTheNextFrame) {
  Measured tile(190);
  tile.raw[2].fill(50);
  tile.raw[7].fill(60);
  for (std::int32_t& column : tile.beams[7].column) column += 150;
  tile.settle();
  EXPECT_EQ(add(tile), 0U);
  EXPECT_EQ(returns.returns(), 10U);
  EXPECT_EQ(returns.row(0, 7).returns, 0U);
  EXPECT_EQ(returns.tile(0).most, 199);
}

TEST_F(MeasuredReturnsTest, ThatFindNoRoomAreCounted) {
  Measured tile(0);
  tile.raw[4][3] = tile.raw[5][3] = 9;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(add(tile), 0U);
  EXPECT_EQ(add(tile), 2U);
  EXPECT_EQ(returns.returns(), 8U);
}

TEST_F(MeasuredReturnsTest, ShareACellThatOneOfThemOwns) {
  Measured tile(20);
  tile.raw[2][0] = 30;
  tile.raw[2][1] = 40;
  tile.raw[2][2] = 20;
  tile.intensity[2][0] = 5;
  tile.intensity[2][1] = 7;
  tile.intensity[2][2] = 7;
  tile.beams[2].column[1] = tile.beams[2].column[2] = 20;
  tile.settle();
  const auto owner_by = [&](CellOwner owner) {
    returns.clear(1);
    EXPECT_EQ(add(tile, owner), 0U);
    EXPECT_EQ(extras().size(), 2U);
    return owner_in(20);
  };
  EXPECT_EQ(owner_by(CellOwner::kFirstArrived), 30);
  EXPECT_EQ(owner_by(CellOwner::kStrongest), 40) << "the earlier one of equals";
  EXPECT_EQ(owner_by(CellOwner::kNearest), 20);
  EXPECT_EQ(owner_by(CellOwner::kFarthest), 40);
}

TEST_F(MeasuredReturnsTest, OfAPairAreCompared) {
  Measured tile(20);
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    const auto pair = static_cast<std::int32_t>(f / 2);
    tile.beams[2].column[f] = 20 + pair;
    const bool is_second = f % 2 == 1;
    tile.raw[2][f] = static_cast<std::uint16_t>(is_second == (pair % 2 == 1) ? 30 : 50);
  }
  tile.settle();
  const auto owners_by = [&](CellOwner owner) {
    returns.clear(1);
    EXPECT_EQ(add(tile, owner), 0U);
    EXPECT_EQ(extras().size(), kTileFirings / 2);
    return std::pair{owner_in(20), owner_in(21)};
  };
  EXPECT_EQ(owners_by(CellOwner::kFirstArrived), (std::pair{30.0F, 50.0F}));
  EXPECT_EQ(owners_by(CellOwner::kNearest), (std::pair{30.0F, 30.0F}));
  EXPECT_EQ(owners_by(CellOwner::kFarthest), (std::pair{50.0F, 50.0F}));
}

TEST_F(MeasuredReturnsTest, OfALaterTileMayTakeACellFromAnEarlierOne) {
  Measured early(20), late(30);
  early.raw[2].fill(30);
  late.raw[2][0] = 10;  // in column 30, as firing 10 of the early one
  EXPECT_EQ(add(early, CellOwner::kNearest), 0U);
  EXPECT_TRUE(extras().empty());
  EXPECT_EQ(add(late, CellOwner::kNearest), 0U);
  EXPECT_EQ(owner_in(30), 10);
  EXPECT_EQ(owner_in(31), 30);
  EXPECT_EQ(extras(), std::vector<float>{30});
}

TEST_F(MeasuredReturnsTest, AreToldOfOnceWhereTheyLoseTheirCellAsPoints) {
  Measured early(20), late(30);
  early.raw[2].fill(30);
  late.raw[2][0] = 10;
  EXPECT_EQ(add(early, CellOwner::kNearest), 0U);
  PointRing points(kShape, std::make_unique<PlainReader>(), memory);
  std::vector<std::pair<int, float>> told;
  const auto tell = [&](int column, float, float range_m) { told.emplace_back(column, range_m); };
  points.begin_turn();
  points.make_until(kShape.columns, returns, tell);
  EXPECT_TRUE(told.empty());
  EXPECT_EQ(add(late, CellOwner::kNearest), 0U);
  points.make_until(kShape.columns, returns, tell);
  EXPECT_EQ(points.planes().x_m[kShape.cell(5, 30)], 10);
  EXPECT_EQ(told, (std::vector{std::pair{30, 30.0F}}));
}

TEST_F(MeasuredReturnsTest, OfTwoLasersMayShareARow) {
  reader.set_row(6, 5);  // as laser 2's
  Measured tile(20);
  tile.raw[2].fill(30);
  tile.raw[6].fill(10);
  EXPECT_EQ(add(tile, CellOwner::kNearest), 0U);
  EXPECT_EQ(returns.row(0, 2).owned, 0U);
  EXPECT_EQ(returns.row(0, 6).owned, returns.row(0, 6).returns);
  EXPECT_EQ(returns.row(0, 6).returns, (1U << kTileFirings) - 1);
}

TEST_F(MeasuredReturnsTest, MayComeToColumnsThatWereLeftOut) {
  Measured around(40), between(40);
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    (f % 2 == 0 ? around : between).raw[2][f] = static_cast<std::uint16_t>(100 + f);
  }
  EXPECT_EQ(add(around), 0U);
  EXPECT_EQ(add(between), 0U);
  for (int f = 0; f < int{kTileFirings}; ++f) {
    EXPECT_EQ(owner_in(40 + f), static_cast<float>(100 + f));
  }
  EXPECT_TRUE(extras().empty());
}

TEST_F(MeasuredReturnsTest, MayLieFarApartInOneTile) {
  Measured tile(5);
  tile.raw[2][0] = 11;
  tile.raw[2][1] = 12;
  tile.raw[2][2] = 13;
  tile.beams[2].column[1] = 150;
  tile.beams[2].column[2] = 150;
  tile.settle();
  EXPECT_EQ(add(tile), 0U);
  EXPECT_EQ(owner_in(5), 11);
  EXPECT_EQ(owner_in(150), 12);
  EXPECT_EQ(extras(), std::vector<float>{13});
}

TEST_F(MeasuredReturnsTest, AreMadePointsOfAsColumnsAreAskedFor) {
  for (const int first : {0, 24, 48}) {
    Measured tile(first);
    for (auto& row : tile.raw) row.fill(static_cast<std::uint16_t>(first + 1));
    EXPECT_EQ(add(tile), 0U);
  }
  PointRing points(kShape, std::make_unique<PlainReader>(), memory);
  const auto has = [&](int column) {
    return !std::isnan(points.planes().z_m[kShape.cell(3, column)]);
  };
  const auto no_extra = [](int, float, float) { ADD_FAILURE() << "each owns its cell"; };
  points.begin_turn();
  points.make_until(30, returns, no_extra);
  EXPECT_TRUE(has(0) && has(29));
  EXPECT_FALSE(has(48));
  points.make_until(60, returns, no_extra);
  EXPECT_TRUE(has(59));
  EXPECT_EQ(points.planes().z_m[kShape.cell(3, 59)], 4);
  EXPECT_EQ(points.planes().y_m[kShape.cell(3, 59)], 59);

  Measured next(0);
  next.raw[4].fill(7);
  returns.clear(2);
  EXPECT_EQ(add(next), 0U);
  points.begin_turn();
  points.make_until(10, returns, no_extra);
  EXPECT_EQ(points.planes().x_m[kShape.cell(3, 5)], 7);
  EXPECT_FALSE(std::isnan(points.planes().z_m[kShape.cell(2, 48)])) << "of the turn before";
  EXPECT_TRUE(std::isnan(points.planes().z_m[kShape.cell(2, 5)])) << "of this one there is none";
  points.make_until(60, returns, no_extra);
  EXPECT_FALSE(has(48));
}

}  // namespace
}  // namespace terracut::frame
