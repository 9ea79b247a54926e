// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Small made-up data sets in every layout that the class tables describe, and in one of a user's.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "calib/beams/angle.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/eval/evaluation.hpp"
#include "tools/research/statistics/measures.hpp"

namespace terracut::datasets {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kPointsPerRing = 1800;

/// A user's own clouds, with labels of one byte.
constexpr const char* kOwnTable = R"(
layout:
  sequences: "drive_*"
  points: "lidar/cloud_*.pcd.bin"
  point_format: nuscenes_bin
  labels: "truth/*.bin"
  label_format: uint8
  rings: 64
  rings_from: field
classes:
  - {id: 1, name: floor, all: ground, road: ground}
  - {id: 2, name: wall, all: key, road: key}
)";

class LayoutsTest : public testing::Test {
 protected:
  /// Flat ground and walls, ring after ring from the top.
  static std::vector<scan::ScanPoint> points(const scan::RingTable& rings = synthetic::table()) {
    return synthetic::scan(rings, {.points_per_ring = kPointsPerRing, .first_azimuth_deg = 0.05});
  }
  static bool is_ground(const scan::ScanPoint& point) { return point.z_m < -1.7; }

  void write_kitti(const std::string& points_file, const std::string& labels_file,
                   std::uint32_t ground, std::uint32_t wall) {
    std::vector<std::uint32_t> labels;
    for (const auto& point : points()) labels.push_back(is_ground(point) ? ground : wall);
    (void)folder_.write_records(points_file, points());
    (void)folder_.write_records(labels_file, labels);
  }
  /// Points in order of firing, lasers numbered from below; x to the right, y ahead.
  void write_nuscenes(const std::string& points_file, const std::string& labels_file,
                      const scan::RingTable& rings, std::uint8_t ground, std::uint8_t wall) {
    const auto by_ring = points(rings);
    std::vector<float> values;
    std::vector<std::uint8_t> labels;
    for (std::size_t i = 0; i < kPointsPerRing; ++i) {
      for (std::size_t ring = 0; ring < rings.size(); ++ring) {
        const auto& point = by_ring[ring * kPointsPerRing + i];
        values.insert(values.end(), {-point.y_m, point.x_m, point.z_m, 255 * point.remission,
                                     static_cast<float>(rings.size() - 1 - ring)});
        labels.push_back(is_ground(point) ? ground : wall);
      }
    }
    (void)folder_.write_records(points_file, values);
    (void)folder_.write_records(labels_file, labels);
  }
  void write_own(const std::string& points_file, const std::string& labels_file) {
    write_nuscenes(points_file, labels_file, synthetic::table(), 1, 2);
  }

  eval::EvaluationConfig config_of(const ClassTable& table) const {
    eval::EvaluationConfig config;
    config.layout = table.layout().value();
    config.root = folder_.path();
    config.jobs = 1;
    config.methods = {*eval::method_named("terracut")};
    return config;
  }
  static Expected<eval::EvaluationOutcome> run(const eval::EvaluationConfig& config) {
    return eval::evaluate(config, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
  }
  Expected<eval::EvaluationOutcome> run(const ClassTable& table) const {
    return run(config_of(table));
  }
  /// One frame of one sequence, with nearly all points where they belong.
  void expect_one_good_frame(const ClassTable& table, const std::string& sequence) const {
    const auto outcome = run(table);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_TRUE(outcome->faults.empty()) << outcome->faults.front().what;
    ASSERT_EQ(outcome->results.size(), 1U);
    const auto& [key, result] = *outcome->results.begin();
    EXPECT_EQ(key.sequence, sequence);
    EXPECT_EQ(result.no_ring, 0U);
    EXPECT_GT(statistics::quality_of(result.counts, table, {}).iou_ground(), 0.9);
    EXPECT_GT(statistics::quality_of(result.counts, table, {}).recall_key_obstacles(), 0.9);
  }
  static std::string refusal_of(const eval::EvaluationConfig& config) {
    const auto outcome = run(config);
    EXPECT_FALSE(outcome);
    if (outcome) return "";
    EXPECT_EQ(outcome.error().code, ErrorCode::kUnsupported);
    return outcome.error().message;
  }
  ClassTable own() const { return *ClassTable::parse(kOwnTable, "own.yaml"); }

  test::ScratchFolder folder_;
};

TEST_F(LayoutsTest, EveryTableThatComesAlongHasALayoutAndClasses) {
  std::vector<std::string_view> names;
  for (const BuiltInTable& table : built_in_tables()) {
    names.push_back(table.dataset);
    const auto parsed = built_in_table(table.dataset);
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_TRUE(parsed->layout()) << table.dataset;
  }
  EXPECT_THAT(names,
              ElementsAre("semantickitti", "koblenz", "rellis3d", "semanticposs", "nuscenes"));
  const auto none = built_in_table("kitti360");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("'kitti360'; there are: semantickitti, koblenz"));
}

TEST_F(LayoutsTest, Rellis3dIsEvaluatedWhereItsFilesAreInOrderOfRings) {
  write_kitti("00004/os1_cloud_node_kitti_bin/000012.bin",
              "00004/os1_cloud_node_semantickitti_label_id/000012.label", 10, 17);
  expect_one_good_frame(*built_in_table("rellis3d"), "00004");
}

TEST_F(LayoutsTest, CloudsInNoOrderOfRingsAreRefusedByFile) {
  auto shuffled = points();
  for (std::size_t i = 0; i < shuffled.size(); ++i) {
    std::swap(shuffled[i], shuffled[i * 7919 % shuffled.size()]);
  }
  write_kitti("00004/os1_cloud_node_kitti_bin/000012.bin",
              "00004/os1_cloud_node_semantickitti_label_id/000012.label", 10, 17);
  (void)folder_.write_records("00004/os1_cloud_node_kitti_bin/000012.bin", shuffled);
  const auto outcome = run(*built_in_table("rellis3d"));
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->results.empty());
  ASSERT_EQ(outcome->faults.size(), 1U);
  EXPECT_THAT(outcome->faults.front().what, HasSubstr("000012.bin"));
}

TEST_F(LayoutsTest, NuscenesIsEvaluatedWithThe32RingsOfItsSensor) {
  scan::RingTable rings;
  for (int ring = 0; ring < 32; ++ring) {
    rings.push_back({beams::deg_to_rad(10.67 - 1.333 * ring), 0});
  }
  write_nuscenes("scene/points/1.pcd.bin", "scene/labels/1.bin", rings, 24, 17);
  expect_one_good_frame(*built_in_table("nuscenes"), "scene");
}

TEST_F(LayoutsTest, OnlyTheRingsOfAnHdl64eAreFoundByOrderOrSentAsPackets) {
  write_kitti("sequences/00/velodyne/000000.bin", "sequences/00/labels/000000.label", 22, 4);
  EXPECT_THAT(refusal_of(config_of(*built_in_table("semanticposs"))),
              HasSubstr("only for sensors with 64 rings, not 40"));
  auto packets = config_of(*built_in_table("nuscenes"));
  packets.through_packets = true;
  EXPECT_THAT(refusal_of(packets), HasSubstr("these have 32 rings"));
}

TEST_F(LayoutsTest, OwnCloudsAreEvaluatedUnderAnOwnTable) {
  write_own("drive_a/lidar/cloud_17.pcd.bin", "drive_a/truth/17.bin");
  expect_one_good_frame(own(), "a");
}

TEST_F(LayoutsTest, FilesThatDoNotFitTheirLayoutAreNamed) {
  write_own("drive_a/lidar/cloud_17.pcd.bin", "drive_a/truth/17.bin");
  write_own("drive_a/lidar/cloud_18.pcd.bin", "drive_a/truth/18.bin");
  write_own("drive_a/lidar/cloud_19.pcd.bin", "drive_a/truth/other.bin");
  (void)folder_.write("drive_a/truth/17.bin", "12");
  (void)folder_.write("drive_a/lidar/cloud_18.pcd.bin", std::string(21, '\1'));
  const auto outcome = run(own());
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->results.empty());
  ASSERT_EQ(outcome->faults.size(), 4U);
  EXPECT_THAT(outcome->faults[0].what, HasSubstr("other.bin: there is no scan for it"));
  EXPECT_THAT(outcome->faults[1].what, HasSubstr("17.bin: 2 labels, but the scan has 115200"));
  EXPECT_THAT(outcome->faults[2].what, HasSubstr("cloud_18.pcd.bin"));
  EXPECT_THAT(outcome->faults[3].what, HasSubstr("there is no label file for it"));
}

TEST_F(LayoutsTest, RingsThatThereCannotBeAreNamed) {
  (void)folder_.write_records("drive_a/lidar/cloud_17.pcd.bin",
                              std::vector<float>{1, 2, 3, 4, 64, 1, 2, 3, 4, 0});
  (void)folder_.write("drive_a/truth/17.bin", "12");
  const auto outcome = run(own());
  ASSERT_TRUE(outcome);
  ASSERT_EQ(outcome->faults.size(), 1U);
  EXPECT_THAT(outcome->faults.front().what,
              HasSubstr("ring of point 0 is 64; expected a whole number from 0 to 63"));
}

std::string layout_refusal(const std::string& layout) {
  const auto table = ClassTable::parse(
      "classes: [{id: 5, name: a, all: key, road: key}]\nlayout:\n" + layout, "t.yaml");
  return table ? "" : table.error().message;
}

TEST(CloudLayout, RefusesByLineWhatItCannotRead) {
  const std::string pcd =
      "  sequences: \"*\"\n  points: \"*.pcd\"\n  point_format: pcd\n  rings: 64\n"
      "  rings_from: field\n";
  EXPECT_EQ(layout_refusal(pcd), "");
  EXPECT_THAT(layout_refusal("  sequences: a\n"),
              HasSubstr("t.yaml: line 3: sequences: expected a relative path with one `*`"));
  EXPECT_THAT(layout_refusal("  points: \"*/*.bin\"\n"), HasSubstr("points: expected"));
  EXPECT_THAT(layout_refusal("  points: \"/data/*.bin\"\n"), HasSubstr("points: expected"));
  EXPECT_THAT(layout_refusal("  point_format: ply\n"), HasSubstr("kitti_bin, nuscenes_bin or pcd"));
  EXPECT_THAT(layout_refusal("  label_format: int16\n"), HasSubstr("uint32 or uint8"));
  EXPECT_THAT(layout_refusal("  rings: many\n"), HasSubstr("whole number from 16 to 128"));
  EXPECT_THAT(layout_refusal("  columns: 100\n"), HasSubstr("whole number from 256 to 8192"));
  EXPECT_THAT(layout_refusal("  rings_from: elevation\n"), HasSubstr("order or field"));
  EXPECT_THAT(layout_refusal("  lasers: 64\n"), HasSubstr("there is no key 'lasers' in a layout"));
  EXPECT_THAT(layout_refusal("  rings: 64\n"), HasSubstr("a layout needs 'sequences'"));
  EXPECT_THAT(layout_refusal(pcd + "  labels: \"*.label\"\n"), HasSubstr("belong together"));
  std::string bin = pcd;
  bin.replace(bin.find("format: pcd"), 11, "format: kitti_bin");
  EXPECT_THAT(layout_refusal(bin), HasSubstr("`labels` is missing"));
  EXPECT_THAT(layout_refusal(bin + "  labels: \"*.label\"\n  label_format: uint32\n"),
              HasSubstr("no field for their ring"));
}

TEST(CloudLayout, ATableOfClassesAloneTakesTheLayoutOfTheDataset) {
  const std::string text = "classes: [{id: 5, name: a, all: key, road: key}]\n";
  auto classes = *ClassTable::parse(text, "t.yaml");
  EXPECT_FALSE(classes.layout());
  classes.take_layout(*built_in_table("koblenz"));
  EXPECT_EQ(to_string(classes.layout().value()), "*;*.pcd;pcd;;uint32;64;2083;field");
  EXPECT_THAT(classes.note(), HasSubstr("could not be found"));
  EXPECT_EQ(classes.entries().size(), 1U);
  classes.take_layout(*built_in_table("nuscenes"));
  EXPECT_THAT(to_string(classes.layout().value()), HasSubstr("*.pcd;"));
  const auto typo = ClassTable::parse(text + "layouts: {}\n", "t.yaml");
  ASSERT_FALSE(typo);
  EXPECT_THAT(typo.error().message, HasSubstr("line 2: there is no key 'layouts'"));
}

}  // namespace
}  // namespace terracut::datasets
