// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Objects and free way of `terracut node`, as a reader of DDS gets them. On loopback.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/dds/mount_transform.hpp"
#include "ros_types.h"
#include "tests/pipeline/dds/one_reader.hpp"
#include "tests/tools/cli/background_program.hpp"

namespace terracut::cli {
namespace {

struct NodeScene : Cli {
  /// Starts a node with these options, and sends it a drive as a driver with these does.
  void start(const std::string& options, const std::string& of_driver = "") {
    const std::string on = fmt::format("--dds-domain {} --dds-interface lo", domain_);
    node_.emplace(folder_, "node",
                  fmt::format("node {} --deadline 10000 --metrics off --name scene_{} {}", on,
                              ::getpid(), options));
    ASSERT_TRUE(node_->says("are answered on"));
    driver_.emplace(
        folder_, "driver",
        fmt::format("replay {} --calibration {} --mount-height 1.73 --mount-roll 0 --mount-pitch 0 "
                    "--rate 1 --loop --dds --raw {} {}",
                    quoted(kDrive), quoted(kDriveCalibration), on, of_driver));
  }

  const int domain_ = 1 + static_cast<int>(::getpid() % 200);
  Expected<dds::Participant> participant_ =
      dds::Participant::open({.domain = domain_, .interface = "lo"});
  std::optional<BackgroundProgram> node_, driver_;
};

struct ObjectsOfNode : NodeScene {
  /// Starts a node, and expects boxes in this frame, whose ground lies at z.
  void expect_boxes(const std::string& options, const std::string& frame_id, double ground_m) {
    dds::OneReader<vision_msgs_msg_dds__Detection3DArray_> reader(
        *participant_, "rt/terracut/objects", vision_msgs_msg_dds__Detection3DArray__desc);
    start("--objects " + options);
    const auto* message = reader.take();
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(std::string(message->header.frame_id), frame_id);
    std::vector<double> bottoms_m;
    for (const auto& box : std::span(message->detections._buffer, message->detections._length)) {
      bottoms_m.push_back(box.bbox.center.position.z - box.bbox.size.z / 2);
    }
    ASSERT_GT(bottoms_m.size(), 5U);
    std::ranges::sort(bottoms_m);
    EXPECT_NEAR(bottoms_m[bottoms_m.size() / 4], ground_m, 0.3) << "things stand on the ground";
  }
};

TEST_F(ObjectsOfNode, LieInTheFrameOfTheClouds) {
  expect_boxes("--base-frame off --mount-height 1.73 --mount-roll 0 --mount-pitch 0",
               "terracut_lidar", -1.73);
}

TEST_F(ObjectsOfNode, LieInTheFrameThatIsAskedFor) {
  expect_boxes("--frame terracut_ground", "terracut_ground", 0);
}

using FreeWayOfNode = NodeScene;

TEST_F(FreeWayOfNode, LiesOnTheGroundBelowTheClouds) {
  const dds::Qos latched = dds::qos_of(dds::kTfMessage, dds::kLatched);
  dds::OneReader<tf2_msgs_msg_dds__TFMessage_> frames(
      *participant_, "rt/tf_static", tf2_msgs_msg_dds__TFMessage__desc, latched.get());
  dds::OneReader<sensor_msgs_msg_dds__LaserScan_> reader(*participant_, "rt/terracut/free_way",
                                                         sensor_msgs_msg_dds__LaserScan__desc);
  start(
      "--free-way --frame-id below --base-frame off --mount-height 1.73 --mount-roll 0 "
      "--mount-pitch 0",
      "--frame-id lidar_top --sensor-frame-id off");  // the driver tells of no frame
  const auto* message = reader.take();
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(std::string(message->header.frame_id), "below");
  const std::span ranges(message->ranges._buffer, message->ranges._length);
  EXPECT_EQ(ranges.size(), 720U);
  EXPECT_GT(std::ranges::count_if(ranges, [](float range) { return std::isfinite(range); }), 100);
  const auto* told = frames.take();
  ASSERT_NE(told, nullptr);
  ASSERT_EQ(told->transforms._length, 1U);
  const auto& transform = told->transforms._buffer[0];
  EXPECT_EQ(std::string(transform.header.frame_id), "lidar_top");
  EXPECT_EQ(std::string(transform.child_frame_id), "below");
  EXPECT_NEAR(transform.transform.translation.z, -1.73, 1e-6);
}

}  // namespace
}  // namespace terracut::cli
