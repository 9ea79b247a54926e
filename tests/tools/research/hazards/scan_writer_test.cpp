// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/scan_writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "flat_scene.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::hazards {
namespace {

class ScanWriterTest : public testing::Test {
 protected:
  [[nodiscard]] scan::KittiScan written(const std::string& name, const mount::Mount& mount,
                                        const MovedReturns& moved) {
    ScanWriter writer(folder_.path());
    const LabelledFrame frame = labelled_frame(scene_.image, scene_.truth, mount, scene_.classes);
    writer.write({.sequence = "00",
                  .name = name,
                  .what = "child",
                  .ground = "road",
                  .from_m = 5,
                  .to_m = 10},
                 frame, mount, moved);
    const Status finished = writer.finish();
    EXPECT_TRUE(finished) << finished.error().message;
    scan::KittiScan scan;
    const auto sequence = folder_.path() / "sequences/00";
    const Status read = scan::read_kitti_scan(sequence / "velodyne" / (name + ".bin"),
                                              sequence / "labels" / (name + ".label"), scan);
    EXPECT_TRUE(read) << read.error().message;
    return scan;
  }

  test::ScratchFolder folder_;
  FlatScene scene_;
};

TEST_F(ScanWriterTest, WritesMovedReturnsWhereTheyLieAndLeavesOutThoseThatAreGone) {
  const MovedReturns moved{{0, 3, true}, {1, 4, false}, {2, 0, false}};
  const scan::KittiScan scan = written("a", scene_.profile.mount, moved);
  ASSERT_EQ(scan.points.size(), scene_.truth.size() - 1);
  int hazard = 0, hidden = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const scan::ScanPoint& point = scan.points[i];
    const double range_m = std::hypot(std::hypot(point.x_m, point.y_m), point.z_m);
    if (scan.labels[i] == (99 | 1U << 16)) {
      EXPECT_NEAR(range_m, 3, 1e-4);
      ++hazard;
    } else if (scan.labels[i] == 0) {
      EXPECT_NEAR(range_m, 4, 1e-4);
      ++hidden;
    } else {
      EXPECT_NEAR(point.z_m, -FlatScene::kHeight_m, 1e-4);
    }
  }
  EXPECT_EQ(hazard, 1);
  EXPECT_EQ(hidden, 1);
}

TEST_F(ScanWriterTest, WritesRingAfterRingWithWhateverMount) {
  for (const mount::Mount& mount :
       {mount::Mount{}, mount::Mount{.height_m = 2, .roll_rad = 0.05, .pitch_rad = -0.02}}) {
    const scan::KittiScan scan = written("b", mount, {});
    scan::RingRecovery rings;
    ASSERT_TRUE(scan::split_into_rings(scan.points, rings));
    const auto rows = static_cast<int>(std::ranges::count_if(
        scene_.profile.rings, [](const auto& ring) { return ring.ground_distance_m < 70; }));
    EXPECT_EQ(rings.rings, rows);
  }
}

TEST_F(ScanWriterTest, SaysWhatEachScanShows) {
  (void)written("c", scene_.profile.mount, {});
  std::ifstream file(folder_.path() / "hazards.json");
  const auto scans = nlohmann::json::parse(file).at("scans");
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].at("scan"), "c");
  EXPECT_EQ(scans[0].at("what"), "child");
  EXPECT_EQ(scans[0].at("ground"), "road");
  EXPECT_EQ(scans[0].at("to_m"), 10);
}

TEST(ScanWriter, SaysWhichFileItCannotWrite) {
  const FlatScene scene;
  ScanWriter writer("/proc/nowhere");
  writer.write({.sequence = "00", .name = "a"}, scene.labelled(), scene.profile.mount, {});
  const Status finished = writer.finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().code, ErrorCode::kWriteFailed);
}

}  // namespace
}  // namespace terracut::hazards
