// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Clouds without rows to labels: patterns that never repeat, and clouds of several sensors or in a
// vehicle's frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware_io/cloud/cloud_file.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "terracut/segmenter.hpp"
#include "tests/support/places.hpp"
#include "tools/lab/quality/quality.hpp"
#include "tools/lab/simulator/cloud_drive.hpp"

namespace terracut::whole_way {
namespace {

using quality::Quality;

void add_labelled(Segmenter& segmenter, const std::vector<scan::ScanPoint>& points,
                  std::span<const std::uint32_t> truth, Quality& sum) {
  std::vector<CloudPoint> cloud;
  for (const scan::ScanPoint& point : points)
    cloud.push_back({point.x_m, point.y_m, point.z_m, point.remission});
  const auto labels = segmenter.label(Cloud{.points = cloud});
  ASSERT_TRUE(labels) << labels.error().message;
  ASSERT_EQ(labels->size(), truth.size());
  std::vector<frame::Label> measured;
  for (const Label label : *labels) {
    measured.push_back(label == Label::kGround ? frame::Label::kGround : frame::Label::kObstacle);
  }
  sum += quality::measure(measured, truth);
}

class Patterns : public testing::TestWithParam<const char*> {};

TEST_P(Patterns, AreLabelledWithoutRows) {
  for (const std::string& scene : {std::string("street"), std::string("hill")}) {
    Segmenter segmenter = Segmenter::make({.find_mount = true}).value();
    Quality sum;
    const Status simulated = simulator::simulate_clouds(
        {.scene = scene, .seed = 4, .duration_s = 0.2}, *simulator::shot_pattern(GetParam()),
        [&](const simulator::SimulatedCloud& cloud) -> Status {
          add_labelled(segmenter, {cloud.points.begin(), cloud.points.end()}, cloud.truth, sum);
          return {};
        });
    ASSERT_TRUE(simulated) << simulated.error().message;
    EXPECT_GT(sum.iou_ground(), 0.90) << scene;
    EXPECT_GT(sum.recall_key_obstacles(), 0.93) << scene;
  }
}

INSTANTIATE_TEST_SUITE_P(, Patterns, testing::Values("avia", "horizon", "mid360_down", "m1"));

/// Labels the two clouds of a folder of Argoverse 2, without their lasers' numbers.
Quality labelled_without_numbers(const std::filesystem::path& folder) {
  Segmenter segmenter = Segmenter::make({.find_mount = true}).value();
  Quality sum;
  for (const char* name : {"000000", "000001"}) {
    cloud::Cloud cloud;
    std::vector<std::uint32_t> truth;
    const std::string stem(name);
    EXPECT_TRUE(cloud::read_cloud(folder / "velodyne" / (stem + ".pcd"), cloud));
    EXPECT_TRUE(
        scan::read_label_file(folder / "labels" / (stem + ".label"), cloud.points.size(), truth));
    add_labelled(segmenter, cloud.points, truth, sum);
  }
  return sum;
}

TEST(CloudsOfTwoSensors, InTheVehiclesFrameAreLabelledAsThoseOfOne) {
  const auto av2 = test::shared_data("av2");
  if (!std::filesystem::exists(av2)) GTEST_SKIP() << "no clouds: shared/data/av2 is not there";
  const Quality upper = labelled_without_numbers(av2 / "up"),
                lower = labelled_without_numbers(av2 / "down"),
                both = labelled_without_numbers(av2 / "both");
  EXPECT_GT(both.iou_ground(), (upper.iou_ground() + lower.iou_ground()) / 2 - 0.005);
  EXPECT_GT(both.recall_key_obstacles(),
            (upper.recall_key_obstacles() + lower.recall_key_obstacles()) / 2 - 0.005);
}

}  // namespace
}  // namespace terracut::whole_way
