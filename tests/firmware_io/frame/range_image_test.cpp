// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/range_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace terracut::frame {
namespace {

struct SmallImage : testing::Test {
  memory::FixedMemory memory;
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

TEST_F(SmallImage, ClearingResetsEverythingWithoutTouchingThePlanes) {
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(image.place(1, 1, {1, 2, 3, 4, 5}));
  image.clear();
  EXPECT_EQ(image.returns(), 0U);
  EXPECT_FALSE(image.has_return(32 + 1));
  EXPECT_TRUE(image.overflow().empty());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(image.place(1, 1, {})) << "there is room again";
  EXPECT_EQ(image.return_index()[32 + 1], 0U);
}

TEST_F(SmallImage, ASecondReturnOfACellGoesToTheOverflowListWithTheNextNumber) {
  ASSERT_TRUE(image.place(2, 5, {1, 0, 0, 1, 0}));
  ASSERT_TRUE(image.place(2, 5, {9, 0, 0, 9, 0}));
  ASSERT_EQ(image.overflow().size(), 1U);
  EXPECT_EQ(image.overflow()[0].cell, 2U * 32U + 5U);
  EXPECT_EQ(image.overflow()[0].return_index, 1U);
  EXPECT_EQ(image.overflow()[0].point.x_m, 9.0F);
  EXPECT_EQ(image.x_m()[2 * 32 + 5], 1.0F) << "the first return keeps the cell";
}

TEST_F(SmallImage, TheOwnerOfACellIsTheReturnAskedForAndTheFirstOfEquals) {
  struct Case {
    CellOwner owner;
    float second_range_m;
    int second_intensity;
    bool second_owns;
  };
  for (const Case& c :
       {Case{CellOwner::kFirstArrived, 1, 9, false}, Case{CellOwner::kStrongest, 9, 6, true},
        Case{CellOwner::kStrongest, 1, 5, false}, Case{CellOwner::kNearest, 4.9F, 0, true},
        Case{CellOwner::kNearest, 5, 9, false}, Case{CellOwner::kFarthest, 5.1F, 0, true},
        Case{CellOwner::kFarthest, 5, 9, false}}) {
    image.clear();
    ASSERT_TRUE(image.place(1, 2, {5, 0, 0.5F, 5, 5}, c.owner));
    ASSERT_TRUE(image.place(1, 2,
                            {c.second_range_m, 0, 0.7F, c.second_range_m,
                             static_cast<std::uint8_t>(c.second_intensity)},
                            c.owner));
    const OverflowReturn& other = image.overflow()[0];
    EXPECT_EQ(image.return_index()[32 + 2], c.second_owns ? 1U : 0U);
    EXPECT_EQ(image.z_m()[32 + 2], c.second_owns ? 0.7F : 0.5F);
    EXPECT_EQ(other.return_index, c.second_owns ? 0U : 1U);
    EXPECT_EQ(other.point.z_m, c.second_owns ? 0.5F : 0.7F);
    EXPECT_EQ(other.point.intensity, c.second_owns ? 5 : c.second_intensity);
  }
}

TEST_F(SmallImage, MovesEachReturnAsItsRowAndColumnSaySecondOnesAsWell) {
  ASSERT_TRUE(image.place(1, 3, {3, 4, 0.5F, 5, 0}));
  ASSERT_TRUE(image.place(1, 3, {6, 8, 0.7F, 10, 0}));
  ASSERT_TRUE(image.place(2, 4, {3, 4, 0.5F, 5, 0}));
  // Row 1 is turned to the left by a quarter and shifted, the farther the higher the column.
  constexpr std::size_t kRows = 4, kColumns = 20;
  const std::vector<float> ones(kColumns, 1.0F), zeros(kColumns, 0.0F);
  std::vector<float> shift_m(kColumns);
  for (std::size_t i = 0; i < kColumns; ++i) shift_m[i] = static_cast<float>(i);
  std::vector<PlanarMotions> by_row(kRows, {ones, zeros, zeros, zeros});
  by_row[1] = {zeros, ones, shift_m, ones};
  image.move(by_row);
  const std::size_t cell = 32 + 3;
  EXPECT_EQ(image.x_m()[cell], -4.0F + 3.0F);
  EXPECT_EQ(image.y_m()[cell], 3.0F + 1.0F);
  EXPECT_EQ(image.z_m()[cell], 0.5F);
  EXPECT_FLOAT_EQ(image.ground_range_m()[cell], std::hypot(1.0F, 4.0F));
  const Return& second = image.overflow()[0].point;
  EXPECT_EQ(second.x_m, -8.0F + 3.0F);
  EXPECT_EQ(second.y_m, 6.0F + 1.0F);
  EXPECT_EQ(second.z_m, 0.7F);
  EXPECT_FLOAT_EQ(second.ground_range_m, std::hypot(5.0F, 7.0F));
  EXPECT_EQ(image.x_m()[2 * 32 + 4], 3.0F) << "its row stays";
}

TEST_F(SmallImage, AFullOverflowListRefusesAndCountsNothing) {
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(image.place(0, 0, {}));
  EXPECT_FALSE(image.place(0, 0, {}));
  EXPECT_EQ(image.returns(), 4U);
  EXPECT_TRUE(image.place(0, 1, {})) << "free cells still take returns";
  EXPECT_EQ(image.return_capacity(), 4U * 32U + 3U);
}

TEST_F(SmallImage, AReturnWithoutAHeightHasANumberAndNoCell) {
  ASSERT_TRUE(image.place(1, 3, {.z_m = kNoHeight_m}));
  ASSERT_TRUE(image.place(1, 4, {}));
  EXPECT_EQ(image.returns(), 2U);
  EXPECT_FALSE(image.has_return(32 + 3));
  EXPECT_EQ(image.return_index()[32 + 4], 1U);
}

}  // namespace
}  // namespace terracut::frame
