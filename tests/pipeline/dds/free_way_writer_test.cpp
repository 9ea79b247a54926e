// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/free_way_writer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <string>

#include "pipeline/free_way/way_grid.hpp"
#include "ros_types.h"
#include "tests/pipeline/dds/one_reader.hpp"

namespace terracut::dds {
namespace {

TEST(FreeWayWriter, PublishesScanPolygonAndGrid) {
  const auto participant =
      Participant::open({.domain = 1 + static_cast<int>(::getpid() % 200), .interface = "lo"});
  if (!participant) GTEST_SKIP() << participant.error().message;
  const std::string topic = "rt/terracut_test/free_way";
  auto writer = FreeWayWriter::open(*participant, topic, {});
  ASSERT_TRUE(writer) << writer.error().message;
  OneReader<sensor_msgs_msg_dds__LaserScan_> scans(*participant, topic,
                                                   sensor_msgs_msg_dds__LaserScan__desc);
  OneReader<geometry_msgs_msg_dds__PolygonStamped_> polygons(
      *participant, topic + "/polygon", geometry_msgs_msg_dds__PolygonStamped__desc);
  OneReader<nav_msgs_msg_dds__OccupancyGrid_> grids(*participant, topic + "/grid",
                                                    nav_msgs_msg_dds__OccupancyGrid__desc);

  publish::LabelledFrame frame;
  frame.record.info.first_packet_ns = 5'250'000'000;
  frame.free_way = {{-1.5F, 8, 5}, {1.5F, std::numeric_limits<float>::infinity(), 6}};
  std::string frame_id = "terracut_ground";
  ASSERT_TRUE(writer->write(frame, frame_id));

  const auto* scan = scans.take();
  ASSERT_NE(scan, nullptr);
  EXPECT_STREQ(scan->header.frame_id, "terracut_ground");
  EXPECT_EQ(scan->header.stamp.sec, 5);
  ASSERT_EQ(scan->ranges._length, 2U);
  EXPECT_EQ(scan->ranges._buffer[0], 8);
  EXPECT_TRUE(std::isinf(scan->ranges._buffer[1]));
  EXPECT_EQ(scan->intensities._buffer[1], 6);
  const auto* polygon = polygons.take();
  ASSERT_NE(polygon, nullptr);
  EXPECT_EQ(polygon->polygon.points._length, 4U);
  const auto* grid = grids.take();
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->data._length, free_way::WayGrid::kSide * free_way::WayGrid::kSide);
  EXPECT_EQ(grid->info.width, free_way::WayGrid::kSide);
}

}  // namespace
}  // namespace terracut::dds
