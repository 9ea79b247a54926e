// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/scan_to_image.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "firmware_io/scan/ring_recovery.hpp"
#include "synthetic_scan.hpp"

namespace terracut::scan {
namespace {

using frame::Label;

TEST(ScanToImage, PutsEachPointAtItsRingAndAzimuth) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 10, memory);
  ScanToImage place(mount::Mount{});
  // Straight ahead, right, behind, left; rings top, bottom, 10, 20.
  const std::vector<ScanPoint> points{
      {10, -0.01F, 0, 1}, {0.01F, -5, -1, 0}, {-3, -0.01F, 2, 0}, {0.01F, 4, 0, 0}};
  const std::vector<std::int16_t> rings{0, 63, 10, 20};
  const auto summary = place.place(points, rings, image);
  EXPECT_EQ(summary.placed, 4U);
  const auto stride = static_cast<std::size_t>(image.shape().stride());
  EXPECT_TRUE(image.has_return(63 * stride + 0));
  EXPECT_TRUE(image.has_return(0 * stride + 89));
  EXPECT_TRUE(image.has_return(53 * stride + 179));
  EXPECT_TRUE(image.has_return(43 * stride + 270));
  EXPECT_FLOAT_EQ(image.z_m()[63 * stride], 1.73F);  // height above the mount's ground plane
  EXPECT_FLOAT_EQ(image.ground_range_m()[0 * stride + 89], std::hypot(0.01F, 5.0F));
  EXPECT_EQ(image.intensity()[63 * stride], 255);
}

TEST(ScanToImage, MovesPointsIntoTheVehicleFrame) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 10, memory);
  ScanToImage place(mount::Mount{2.0, 0.0, 0.1});  // pitched down in front
  const std::vector<ScanPoint> points{{10, -0.01F, 0, 1}};
  place.place(points, std::vector<std::int16_t>{0}, image);
  const std::size_t cell = 63 * static_cast<std::size_t>(image.shape().stride());
  ASSERT_TRUE(image.has_return(cell));
  EXPECT_NEAR(image.z_m()[cell], 2.0 - 10 * std::sin(0.1), 1e-5);
}

TEST(ScanToImage, TurnsASensorOverThatHangsUpsideDown) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 10, memory);
  ScanToImage place(mount::Mount{.height_m = 2, .roll_rad = std::numbers::pi});
  // What the sensor has above it to the left is below to the right of the vehicle.
  place.place(std::vector<ScanPoint>{{0.01F, 5, 1.5F, 0}}, std::vector<std::int16_t>{3}, image);
  const std::size_t cell = 3 * static_cast<std::size_t>(image.shape().stride()) + 89;
  ASSERT_TRUE(image.has_return(cell));
  EXPECT_FLOAT_EQ(image.y_m()[cell], -5);
  EXPECT_FLOAT_EQ(image.z_m()[cell], 0.5);
}

TEST(ScanToImage, BringsLabelsBackIntoTheFilesOrder) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 360}, 1, memory);
  ScanToImage place(mount::Mount{});
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::vector<ScanPoint> points{{10, -0.01F, 0, 0},  // placed: return 0
                                      {kNaN, 0, 0, 0},     // no place
                                      {9, -0.01F, 0, 0},   // same cell: overflow, return 1
                                      {8, -0.01F, 0, 0},   // same cell: overflow list is full
                                      {7, -0.01F, 0, 0},   // no ring
                                      {10, -5, 0, 0}};     // placed: return 2
  const std::vector<std::int16_t> rings{5, kNoRing, 5, 5, kNoRing, 5};
  const auto summary = place.place(points, rings, image);
  EXPECT_EQ(summary.placed, 3U);
  EXPECT_EQ(summary.no_place, 1U);
  EXPECT_EQ(summary.no_ring, 1U);
  EXPECT_EQ(summary.overflow_full, 1U);
  EXPECT_EQ(image.returns(), 3U);
  ASSERT_EQ(place.point_of_return().size(), 3U);
  EXPECT_EQ(place.point_of_return()[2], 5U);

  std::vector<Label> labels;
  place.labels_of_points(std::vector<Label>{Label::kGround, Label::kGround, Label::kGround},
                         labels);
  EXPECT_EQ(labels, (std::vector<Label>{Label::kGround, Label::kNone, Label::kGround,
                                        Label::kObstacle, Label::kObstacle, Label::kGround}));
}

TEST(ScanToImage, LabelsEveryPointOfAWholeScan) {
  memory::FixedMemory memory;
  frame::RangeImage image({64, 1800}, 40000, memory);
  ScanToImage place(mount::Mount{});
  const auto points = synthetic::scan(synthetic::table());
  RingRecovery rings;
  ASSERT_TRUE(recover_rings(points, nullptr, rings));
  const auto summary = place.place(points, rings.ring_of_point, image);
  EXPECT_EQ(summary.placed, points.size());
  EXPECT_EQ(image.returns(), points.size());
  std::vector<Label> of_points;
  place.labels_of_points(std::vector<Label>(points.size(), Label::kGround), of_points);
  EXPECT_EQ(of_points, std::vector<Label>(points.size(), Label::kGround));
}

}  // namespace
}  // namespace terracut::scan
