// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/range_image.hpp"

#include <gtest/gtest.h>

namespace terracut::pipeline {
namespace {

struct SmallImage : testing::Test {
  rt::FixedMemory memory;
  RangeImage image{{4, 20}, 3, memory};
};

TEST_F(SmallImage, StrideIsPaddedToSixteen) {
  EXPECT_EQ(image.shape().stride(), 32);
  EXPECT_EQ(image.shape().cells(), 4U * 32U);
}

TEST_F(SmallImage, NumbersReturnsInTheOrderOfArrival) {
  ASSERT_TRUE(image.place(3, 19, {1, 2, 3, 4, 5}));
  ASSERT_TRUE(image.place(0, 0, {6, 7, 8, 9, 10}));
  const std::size_t first = 3 * 32 + 19;
  EXPECT_EQ(image.returns(), 2U);
  EXPECT_EQ(image.return_index()[first], 0U);
  EXPECT_EQ(image.return_index()[0], 1U);
  EXPECT_EQ(image.z_m()[first], 3.0F);
  EXPECT_EQ(image.ground_range_m()[0], 9.0F);
  EXPECT_EQ(image.intensity()[0], 10);
}

TEST_F(SmallImage, ClearingForgetsEverythingWithoutTouchingThePlanes) {
  ASSERT_TRUE(image.place(1, 1, {1, 2, 3, 4, 5}));
  image.clear();
  EXPECT_EQ(image.returns(), 0U);
  EXPECT_FALSE(image.has_return(32 + 1));
}

TEST_F(SmallImage, ASecondReturnOfACellGoesToTheOverflowListWithTheNextNumber) {
  ASSERT_TRUE(image.place(2, 5, {1, 0, 0, 1, 0}));
  ASSERT_TRUE(image.place(2, 5, {9, 0, 0, 9, 0}));
  ASSERT_EQ(image.overflow().size(), 1U);
  EXPECT_EQ(image.overflow()[0].cell, 2U * 32U + 5U);
  EXPECT_EQ(image.overflow()[0].return_index, 1U);
  EXPECT_EQ(image.overflow()[0].echo.x_m, 9.0F);
  EXPECT_EQ(image.x_m()[2 * 32 + 5], 1.0F) << "the first return keeps the cell";
}

TEST_F(SmallImage, AFullOverflowListRefusesAndCountsNothing) {
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(image.place(0, 0, {}));
  EXPECT_FALSE(image.place(0, 0, {}));
  EXPECT_EQ(image.returns(), 4U);
  EXPECT_TRUE(image.place(0, 1, {})) << "free cells still take returns";
  EXPECT_EQ(image.return_capacity(), 4U * 32U + 3U);
}

TEST_F(SmallImage, ReturnsNumberedAheadArePlacedInAnyOrder) {
  ASSERT_TRUE(image.place(0, 0, {}));
  ASSERT_EQ(image.take_numbers(3), 1U);
  ASSERT_TRUE(image.place_numbered(1, 1, {1, 0, 0, 1, 0}, CellOwner::kFirstArrived, 3));
  ASSERT_TRUE(image.place_numbered(2, 2, {2, 0, 0, 2, 0}, CellOwner::kFirstArrived, 1));
  ASSERT_TRUE(image.place_numbered(2, 2, {3, 0, 0, 3, 0}, CellOwner::kFarthest, 2));
  ASSERT_TRUE(image.place(3, 3, {}));
  EXPECT_EQ(image.returns(), 5U);
  EXPECT_EQ(image.return_index()[1 * 32 + 1], 3U);
  EXPECT_EQ(image.return_index()[2 * 32 + 2], 2U);
  EXPECT_EQ(image.overflow()[0].return_index, 1U);
  EXPECT_EQ(image.return_index()[3 * 32 + 3], 4U);
}

TEST_F(SmallImage, NumbersAreOnlyHandedOutWhenAllOfThemCouldShareACell) {
  EXPECT_EQ(image.take_numbers(4), std::nullopt);
  EXPECT_EQ(image.returns(), 0U);
  EXPECT_EQ(image.take_numbers(3), 0U);
}

}  // namespace
}  // namespace terracut::pipeline
