// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/near_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace terracut::ground {
namespace {

/// Every cell has a return: row r lies `2 + r / 2` metres away at height r / 1000.
void fill(frame::RangeImage& image) {
  image.clear();
  for (int row = 0; row < image.shape().rows; ++row) {
    for (int column = 0; column < image.shape().columns; ++column) {
      const double azimuth = 2 * std::numbers::pi * (column + 0.5) / image.shape().columns;
      const double range_m = 2 + row / 2.0;
      frame::Return point;
      point.x_m = static_cast<float>(range_m * std::cos(azimuth));
      point.y_m = static_cast<float>(-range_m * std::sin(azimuth));
      point.z_m = static_cast<float>(row) / 1000;
      point.ground_range_m = static_cast<float>(range_m);
      image.place(row, column, point);
    }
  }
}

std::size_t in_strip(const frame::RangeImage& image) {
  std::size_t count = 0;
  for (int row = 0; row < image.shape().rows; ++row) {
    for (int column = 0; column < image.shape().columns; ++column) {
      const std::size_t cell = image.shape().cell(row, column);
      count += is_near_ground_place(image.x_m()[cell], image.y_m()[cell]) ? 1U : 0U;
    }
  }
  return count;
}

TEST(NearGround, HoldsEveryReturnOfTheStripWhereTheImageIsSmall) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 1, memory);
  fill(image);
  const auto ground = std::make_unique<NearGround>();
  take_near_ground(image, *ground);
  EXPECT_EQ(ground->count, in_strip(image));
  EXPECT_GT(ground->count, 500U);
  std::size_t ahead = 0, left = 0;
  for (const auto& [x, y, z] : ground->in_use()) {
    EXPECT_TRUE(is_near_ground_place(x, y)) << x << " " << y;
    ahead += x > 0 ? 1U : 0U;
    left += y > 0 ? 1U : 0U;
  }
  EXPECT_EQ(2 * ahead, ground->count) << "as much before the vehicle as behind";
  EXPECT_EQ(2 * left, ground->count);
}

TEST(NearGround, ThinsLargeImagesOutEvenly) {
  memory::FixedMemory memory;
  frame::RangeImage image({128, 1801}, 1, memory);
  fill(image);
  const auto ground = std::make_unique<NearGround>();
  take_near_ground(image, *ground);
  const double share = static_cast<double>(ground->count) / static_cast<double>(in_strip(image));
  constexpr int kStep = 3;  // 2 x 300 columns of 128 rows, of which 32768 are looked at
  EXPECT_NEAR(share, 1.0 / kStep, 0.02);
}

TEST(NearGround, OfAllAroundIsEvenlyTakenOfTheWholeImage) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 1, memory);
  fill(image);
  const auto around = std::make_unique<NearGround>();
  take_around(image, *around);
  EXPECT_EQ(around->count, 64U * 360 / 3);
  std::size_t far = 0;
  for (const auto& [x, y, z] : around->in_use()) far += std::hypot(x, y) > 18.2 ? 1U : 0U;
  EXPECT_EQ(far, around->count / 2 - 120);
}

TEST(NearGround, IsEmptyOfAnEmptyFrame) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 1, memory);
  fill(image);
  image.clear();
  const auto ground = std::make_unique<NearGround>();
  ground->count = 7;
  take_near_ground(image, *ground);
  EXPECT_EQ(ground->count, 0U);
}

}  // namespace
}  // namespace terracut::ground
