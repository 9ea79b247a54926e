// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/free_way_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/free_way/way_grid.hpp"

namespace terracut::ros_messages {
namespace {

using free_way::SeenEnd;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kEighth_rad = std::numbers::pi_v<float> / 4;

/// A frame of 0.1 s with four sectors: ahead to the right, behind to the right, behind to the left,
/// ahead to the left.
publish::LabelledFrame frame_with_free_way() {
  publish::LabelledFrame frame;
  frame.record.info.first_packet_ns = 5'250'000'000;
  frame.record.info.last_packet_ns = 5'350'000'000;
  frame.free_way = {{-kEighth_rad, 8, 5, SeenEnd::kRows},
                    {-3 * kEighth_rad, 30, 10, SeenEnd::kDrop},
                    {3 * kEighth_rad, kInfinity, 0, SeenEnd::kLost},
                    {kEighth_rad, kInfinity, 6, SeenEnd::kRows}};
  return frame;
}

TEST(WayScan, GoesCounterclockwiseFromBehind) {
  const WayScan scan = way_scan(frame_with_free_way());
  EXPECT_FLOAT_EQ(scan.first_rad, -3 * kEighth_rad);
  EXPECT_FLOAT_EQ(scan.step_rad, 2 * kEighth_rad);
  EXPECT_FLOAT_EQ(scan.last_rad, 3 * kEighth_rad);
  EXPECT_FLOAT_EQ(scan.turn_s, 0.1F);
  EXPECT_EQ(scan.seen_m, (std::vector<float>{10, 5, 6, 0}));
}

TEST(WayScan, EndsAtObstaclesAndDropsAndSaysWhatIsNotKnownAsRep117Does) {
  const WayScan scan = way_scan(frame_with_free_way());
  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_EQ(scan.ranges_m[0], 10) << "the edge of a drop before an obstacle";
  EXPECT_EQ(scan.ranges_m[1], 8) << "an obstacle behind the ground that was seen";
  EXPECT_EQ(scan.ranges_m[2], kInfinity) << "none";
  EXPECT_TRUE(std::isnan(scan.ranges_m[3])) << "nothing was seen";
}

TEST(WayScan, OfAFrameWithoutFreeWayIsEmpty) {
  EXPECT_TRUE(way_scan({}).ranges_m.empty());
}

TEST(FreeWayMessages, ScanIsALaserScan) {
  std::vector<std::byte> message;
  write_free_way_scan(frame_with_free_way(), "abc", message);
  // A header of 8 + 4 + 4 bytes, seven numbers, and two sequences of four.
  EXPECT_EQ(message.size(), 4 + 16 + 28 + 2 * (4 + 16U));
}

TEST(FreeWayMessages, PolygonHasTwoCornersASector) {
  std::vector<std::byte> message;
  write_free_way_polygon(frame_with_free_way(), "abc", message);
  EXPECT_EQ(message.size(), 4 + 16 + 4 + 8 * 12U);
}

TEST(FreeWayMessages, GridIsAnOccupancyGrid) {
  std::vector<std::byte> message;
  write_free_way_grid(frame_with_free_way(), "abc", message);
  constexpr std::size_t kCells = free_way::WayGrid::kSide * free_way::WayGrid::kSide;
  // A header, a time, three numbers of 4 bytes, a pose of 8-byte numbers after padding.
  EXPECT_EQ(message.size(), 4 + 16 + 8 + 12 + 4 + 56 + 4 + kCells);
}

}  // namespace
}  // namespace terracut::ros_messages
