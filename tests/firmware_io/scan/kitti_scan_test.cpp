// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/kitti_scan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::scan {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<ScanPoint> three_points() {
  return {{1, 2, 3, 0.5F}, {4, 5, 6, 0.25F}, {-7, -8, -9, 1.0F}};
}

TEST(KittiScan, ReadsPointsAndLabelsInTheFilesOrder) {
  const test::ScratchFolder folder;
  const auto bin = folder.write_records("a.bin", three_points());
  const auto label = folder.write_records("a.label", std::vector<std::uint32_t>{40, 0x20000A, 72});
  KittiScan scan;
  ASSERT_TRUE(read_kitti_scan(bin, label, scan));
  ASSERT_EQ(scan.points.size(), 3U);
  EXPECT_EQ(scan.points[2].y_m, -8.0F);
  EXPECT_EQ(scan.points[1].remission, 0.25F);
  EXPECT_EQ(semantic_class(scan.labels[1]), 10);
  EXPECT_EQ(scan.no_place, 0U);
}

TEST(KittiScan, ResetsTheScanBeforeWhenItIsReused) {
  const test::ScratchFolder folder;
  const auto bin = folder.write_records("a.bin", three_points());
  const auto label = folder.write_records("a.label", std::vector<std::uint32_t>{1, 2, 3});
  const auto other = folder.write_records("b.bin", std::vector<ScanPoint>{{1, 1, 1, 0}});
  KittiScan scan;
  ASSERT_TRUE(read_kitti_scan(bin, label, scan));
  ASSERT_TRUE(read_kitti_scan(other, scan));
  EXPECT_EQ(scan.points.size(), 1U);
  EXPECT_TRUE(scan.labels.empty());
}

TEST(KittiScan, RefusesAMissingFileByName) {
  KittiScan scan;
  const Status status = read_kitti_scan("no/such/scan.bin", scan);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(status.error().message, HasSubstr("no/such/scan.bin"));
}

TEST(KittiScan, RefusesAnEmptyFile) {
  const test::ScratchFolder folder;
  KittiScan scan;
  const Status status = read_kitti_scan(folder.write("a.bin", ""), scan);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(status.error().message, AllOf(HasSubstr("a.bin"), HasSubstr("empty")));
}

TEST(KittiScan, RefusesATruncatedFileAndSaysWhereItsLastWholePointEnds) {
  const test::ScratchFolder folder;
  KittiScan scan;
  const Status status = read_kitti_scan(folder.write("a.bin", std::string(37, 'x')), scan);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message,
              AllOf(HasSubstr("truncated"), HasSubstr("37 bytes"), HasSubstr("byte 32")));
}

TEST(KittiScan, RefusesAFileLargerThanAnyFrameWithoutReadingIt) {
  const test::ScratchFolder folder;
  const auto bin = folder.write("a.bin", "x");
  std::filesystem::resize_file(bin, (kMaxScanPoints + 1) * 16);  // sparse
  KittiScan scan;
  const Status status = read_kitti_scan(bin, scan);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("at most 1048576"));
}

TEST(KittiScan, RefusesAFolderInTheFilesPlace) {
  const test::ScratchFolder folder;
  KittiScan scan;
  const Status status = read_kitti_scan(folder.path(), scan);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kUnreadable);
}

TEST(KittiScan, CountsPointsThatAreNoPlaceAndKeepsTheirEntries) {
  const test::ScratchFolder folder;
  auto points = three_points();
  points[0].y_m = kNaN;
  points[1].x_m = 3e38F;
  points[2].z_m = -kInfinity;
  points.push_back({1, 0, -1, 0});
  points.push_back({0, -0.0F, 0, 0.3F});  // null: no return, whatever its remission
  points.push_back({0, 0, -1.7F, 0});
  KittiScan scan;
  ASSERT_TRUE(read_kitti_scan(folder.write_records("a.bin", points), scan));
  EXPECT_EQ(scan.points.size(), 6U);
  EXPECT_EQ(scan.no_place, 4U);
}

TEST(KittiScan, RefusesAScanWithoutAFinitePoint) {
  const test::ScratchFolder folder;
  KittiScan scan;
  const Status status = read_kitti_scan(
      folder.write_records("a.bin", std::vector<ScanPoint>{{kNaN, 0, 0, 0}, {0, kNaN, 0, 0}}),
      scan);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("none of the 2 points is finite"));
}

TEST(KittiScan, RefusesLabelsOfAnotherCount) {
  const test::ScratchFolder folder;
  const auto bin = folder.write_records("a.bin", three_points());
  const auto label = folder.write_records("a.label", std::vector<std::uint32_t>{1, 2});
  KittiScan scan;
  const Status status = read_kitti_scan(bin, label, scan);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message,
              AllOf(HasSubstr("a.label"), HasSubstr("2 labels"), HasSubstr("3 points")));
}

TEST(KittiScan, AzimuthGrowsClockwiseFromStraightAhead) {
  EXPECT_EQ(azimuth_rad(1, 0), 0.0);
  EXPECT_NEAR(azimuth_rad(0, -1), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(azimuth_rad(-1, 0), std::numbers::pi, 1e-15);
  EXPECT_NEAR(azimuth_rad(0, 1), 3 * std::numbers::pi / 2, 1e-15);
}

TEST(KittiScan, AzimuthTakesNegativeZeroAsZeroAndStaysBelowAWholeRevolution) {
  EXPECT_EQ(azimuth_rad(1, -0.0), 0.0);
  EXPECT_FALSE(std::signbit(azimuth_rad(1, 0.0)));
  EXPECT_NEAR(azimuth_rad(-1, -0.0), std::numbers::pi, 1e-15);
  EXPECT_LT(azimuth_rad(1, 1e-300), 2 * std::numbers::pi);
}

TEST(KittiScan, IntensityCoversAByteAndClampsTheRest) {
  EXPECT_EQ(intensity_of(0.0F), 0);
  EXPECT_EQ(intensity_of(1.0F), 255);
  EXPECT_EQ(intensity_of(0.5F), 128);
  EXPECT_EQ(intensity_of(-1.0F), 0);
  EXPECT_EQ(intensity_of(7.0F), 255);
  EXPECT_EQ(intensity_of(kNaN), 0);
}

TEST(LabelFile, WritesWhatItReads) {
  const test::ScratchFolder folder;
  const std::vector<std::uint32_t> labels{0, 40, 0xFFFF0063};
  ASSERT_TRUE(write_label_ids(folder.path() / "a.label", labels));
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "a.label"), 12U);
  std::vector<std::uint32_t> read;
  ASSERT_TRUE(read_label_file(folder.path() / "a.label", 0, read));
  EXPECT_EQ(read, labels);
}

TEST(ScanFolder, ListsASequenceByNameWithItsLabelsAndPoses) {
  const test::ScratchFolder folder;
  folder.write("velodyne/000010.bin", "x");
  folder.write("velodyne/000002.bin", "x");
  folder.write("velodyne/notes.txt", "x");
  folder.write("labels/000002.label", "x");
  folder.write("poses.txt", "x");
  const auto found = list_scan_folder(folder.path());
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->scans.size(), 2U);
  EXPECT_EQ(found->scans[0].name, "000002");
  EXPECT_EQ(found->scans[1].frame, 10U);
  EXPECT_TRUE(found->scans[0].labels.has_value());
  EXPECT_FALSE(found->scans[1].labels.has_value());
  EXPECT_TRUE(found->poses.has_value());
  EXPECT_FALSE(found->times.has_value());
}

TEST(ScanFolder, ListsAPlainFolderWithLabelsBesideTheScans) {
  const test::ScratchFolder folder;
  folder.write("first.bin", "x");
  folder.write("first.label", "x");
  const auto found = list_scan_folder(folder.path());
  ASSERT_TRUE(found);
  ASSERT_EQ(found->scans.size(), 1U);
  EXPECT_TRUE(found->scans[0].labels.has_value());
  EXPECT_FALSE(found->scans[0].frame.has_value());
}

TEST(ScanFolder, RefusesTwoScansOfOneNameBecauseTheirOutputsWouldBeOneFile) {
  for (const char* twin : {"a.pcd.bin", "a.BIN", "a.PCD.bin"}) {
    const test::ScratchFolder folder;
    folder.write("a.bin", "x");
    folder.write("b.bin", "x");
    folder.write(twin, "x");
    const auto found = list_scan_folder(folder.path());
    ASSERT_FALSE(found) << twin;
    EXPECT_EQ(found.error().code, ErrorCode::kMalformed);
    EXPECT_THAT(found.error().message, AllOf(HasSubstr("a.bin"), HasSubstr(twin)));
    EXPECT_TRUE(list_scan_folder(folder.path() / twin)) << "named alone";
  }
}

TEST(ScanFolder, TakesNamesInUpperCaseAndNoHiddenFiles) {
  const test::ScratchFolder folder;
  folder.write("000001.BIN", "x");
  folder.write("000000.bin", "x");
  folder.write("._000000.bin", "x");
  const auto found = list_scan_folder(folder.path());
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->scans.size(), 2U);
  EXPECT_EQ(found->scans[1].points.filename(), "000001.BIN");
  EXPECT_EQ(found->scans[1].frame, 1U);
}

TEST(ScanFolder, SaysOfAFileThatItIsNoScanNotThatThereIsNoSuchFolder) {
  const test::ScratchFolder folder;
  const auto found = list_scan_folder(folder.write("scan.csv", "1,2,3"));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(found.error().message, HasSubstr("no scan by its name; expected KITTI's .bin"));
}

TEST(ScanFolder, SaysWhatItExpectedWhereThereIsNoScan) {
  const test::ScratchFolder folder;
  const auto empty = list_scan_folder(folder.path());
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message, HasSubstr("no scan in it; expected KITTI's .bin"));
  const auto missing = list_scan_folder(folder.path() / "missing");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace terracut::scan
