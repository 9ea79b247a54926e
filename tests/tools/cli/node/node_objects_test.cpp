// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The objects of `terracut node`, as a reader of DDS gets them. On loopback.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ros_types.h"
#include "tests/pipeline/dds/one_reader.hpp"
#include "tests/tools/cli/background_program.hpp"

namespace terracut::cli {
namespace {

using Boxes = vision_msgs_msg_dds__Detection3DArray_;

struct NodeObjects : Cli {
  /// Boxes in the first message of a node with these options, to which a drive is sent as by a
  /// driver, and how low the lowest quarter of them begins.
  struct Seen {
    std::string frame_id;
    std::size_t count = 0;
    double low_m = 0;
  };
  [[nodiscard]] Seen seen_by(const std::string& options) const {
    const int domain = 1 + static_cast<int>(::getpid() % 200);
    auto participant = dds::Participant::open({.domain = domain, .interface = "lo"});
    if (!participant) return {};
    dds::OneReader<Boxes> boxes(*participant, "rt/terracut/objects",
                                vision_msgs_msg_dds__Detection3DArray__desc);
    const std::string on = fmt::format("--dds-domain {} --dds-interface lo", domain);
    BackgroundProgram node(folder_, "node",
                           fmt::format("node {} --objects --deadline 10000 --metrics off "
                                       "--name objects_{} {}",
                                       on, ::getpid(), options));
    if (!node.says("are answered on")) return {};
    const BackgroundProgram driver(
        folder_, "driver",
        fmt::format("replay {} --calibration {} --mount-height 1.73 --mount-roll 0 --mount-pitch 0 "
                    "--rate 1 --loop --dds --raw {}",
                    quoted(kDrive), quoted(kDriveCalibration), on));
    const Boxes* message = boxes.take();
    if (message == nullptr) return {};
    std::vector<double> bottoms_m;
    for (std::uint32_t i = 0; i < message->detections._length; ++i) {
      const auto& box = message->detections._buffer[i].bbox;
      bottoms_m.push_back(box.center.position.z - box.size.z / 2);
    }
    std::ranges::sort(bottoms_m);
    return {message->header.frame_id, bottoms_m.size(),
            bottoms_m.empty() ? 0 : bottoms_m[bottoms_m.size() / 4]};
  }
};

TEST_F(NodeObjects, LieInTheFrameOfTheClouds) {
  const Seen seen = seen_by("--base-frame off --mount-height 1.73 --mount-roll 0 --mount-pitch 0");
  EXPECT_EQ(seen.frame_id, "terracut_lidar");
  EXPECT_GT(seen.count, 5U);
  EXPECT_NEAR(seen.low_m, -1.73, 0.3) << "things stand on the ground, which is below the sensor";
}

TEST_F(NodeObjects, LieInTheFrameThatIsAskedFor) {
  const Seen seen = seen_by("--frame terracut_ground");
  EXPECT_EQ(seen.frame_id, "terracut_ground");
  EXPECT_GT(seen.count, 5U);
  EXPECT_NEAR(seen.low_m, 0, 0.3);
}

}  // namespace
}  // namespace terracut::cli
