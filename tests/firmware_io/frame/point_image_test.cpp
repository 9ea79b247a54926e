// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/point_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "firmware_io/frame/each_return.hpp"
#include "tests/firmware_io/frame/plain_tiles.hpp"

namespace terracut::frame {
namespace {

struct PointImageTest : testing::Test {
  static constexpr ImageShape kShape{8, 200};

  std::uint32_t add(const test::PlainTile& tile, CellOwner owner = CellOwner::kFirstArrived) {
    return tile.add_to(returns, reader, owner);
  }

  memory::FixedMemory memory;
  test::PlainReader reader;
  MeasuredReturns returns{kShape, test::kPlainLasers, 4, memory};
  PointImage points{kShape, returns.return_capacity(), std::make_unique<test::PlainReader>(),
                    memory};
};

TEST_F(PointImageTest, HasEveryReturnWithItsNumberAndIntensity) {
  test::PlainTile tile(10);
  tile.raw[0][0] = tile.raw[3][0] = 100;
  tile.raw[3][5] = 200;
  tile.intensity[3][5] = 9;
  EXPECT_EQ(add(tile), 0U);
  const RangeImage& image = points.make(returns);
  EXPECT_EQ(image.returns(), 3U);
  EXPECT_TRUE(image.overflow().empty());
  const std::size_t cell = kShape.cell(4, 15);
  ASSERT_TRUE(image.has_return(cell));
  EXPECT_EQ(image.x_m()[cell], 200);
  EXPECT_EQ(image.y_m()[cell], 15);
  EXPECT_EQ(image.z_m()[cell], 3);
  EXPECT_EQ(image.ground_range_m()[cell], 200);
  EXPECT_EQ(image.intensity()[cell], 9);
  EXPECT_EQ(image.return_index()[cell], 2U);
  EXPECT_EQ(image.return_index()[kShape.cell(4, 10)], 1U);
  EXPECT_FALSE(image.has_return(kShape.cell(4, 11))) << "a firing of the run that found nothing";
  EXPECT_FALSE(image.has_return(kShape.cell(3, 15)));
}

TEST_F(PointImageTest, HasOneOwnerInACellAndTheOthersInTheOverflowList) {
  test::PlainTile early(20), late(30);
  early.raw[2].fill(30);
  early.beams[2].column[1] = 20;  // as firing 0
  early.settle();
  late.raw[2][0] = 10;  // in column 30, as firing 10 of the early one
  EXPECT_EQ(add(early, CellOwner::kNearest), 0U);
  EXPECT_EQ(add(late, CellOwner::kNearest), 0U);
  const RangeImage& image = points.make(returns);
  EXPECT_EQ(image.x_m()[kShape.cell(5, 30)], 10);
  EXPECT_EQ(image.return_index()[kShape.cell(5, 30)], kTileFirings);
  ASSERT_EQ(image.overflow().size(), 2U);
  EXPECT_EQ(image.overflow()[0].cell, kShape.cell(5, 20));
  EXPECT_EQ(image.overflow()[0].return_index, 1U);
  EXPECT_EQ(image.overflow()[0].point.y_m, 21);
  EXPECT_EQ(image.overflow()[1].cell, kShape.cell(5, 30));
  EXPECT_EQ(image.overflow()[1].return_index, 10U);
  EXPECT_EQ(image.overflow()[1].point.x_m, 30);
}

TEST_F(PointImageTest, LosesNoReturnThatAFrameHasHoweverManyShareACell) {
  test::PlainTile tile(0);
  for (std::size_t i = 0; i < test::kPlainLasers; ++i) {
    tile.raw[i].fill(7);
    tile.beams[i].column.fill(3);
  }
  tile.settle();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(add(tile), 0U);
  ASSERT_EQ(returns.returns(), returns.return_capacity());
  std::vector<int> seen(returns.returns());
  for_each_return(points.make(returns),
                  [&](const PlacedReturn& placed) { ++seen[placed.return_index]; });
  EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
}

TEST_F(PointImageTest, HoldsOneFrameAfterTheOther) {
  test::PlainTile tile(10);
  tile.raw[0].fill(100);
  EXPECT_EQ(add(tile), 0U);
  EXPECT_EQ(points.make(returns).returns(), kTileFirings);
  returns.clear(1);
  test::PlainTile other(50);
  other.raw[0][0] = 5;
  EXPECT_EQ(add(other), 0U);
  const RangeImage& image = points.make(returns);
  EXPECT_EQ(image.returns(), 1U);
  EXPECT_FALSE(image.has_return(kShape.cell(7, 10)));
  EXPECT_TRUE(image.has_return(kShape.cell(7, 50)));
}

TEST_F(PointImageTest, MovesPointsWhereTheFrameIsDeskewed) {
  test::PlainTile tile(10);
  tile.raw[0][0] = 3;
  EXPECT_EQ(add(tile), 0U);
  const std::vector<float> ones(200, 1), zeros(200, 0), two(200, 2);
  const std::vector<PlanarMotions> motions(8, {ones, zeros, two, zeros});
  const std::size_t cell = kShape.cell(7, 10);
  const RangeImage& moved = points.make(returns, motions);
  EXPECT_EQ(moved.x_m()[cell], 5);
  EXPECT_EQ(moved.y_m()[cell], 10);
  EXPECT_EQ(moved.ground_range_m()[cell], std::sqrt(125.0F));
  EXPECT_EQ(points.make(returns).x_m()[cell], 3) << "as seen";
}

}  // namespace
}  // namespace terracut::frame
