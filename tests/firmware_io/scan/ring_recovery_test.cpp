// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/ring_recovery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "synthetic_scan.hpp"

namespace terracut::scan {
namespace {

using testing::HasSubstr;

/// Points whose ring is not the one the synthetic scan gave them.
std::size_t misplaced(const RingRecovery& recovery, int points_per_ring,
                      const std::vector<int>& missing_rings = {}) {
  std::vector<int> rings;
  for (int ring = 0; ring < kScanRings; ++ring) {
    if (std::find(missing_rings.begin(), missing_rings.end(), ring) == missing_rings.end()) {
      rings.push_back(ring);
    }
  }
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < recovery.ring_of_point.size(); ++i) {
    const int truth = rings[i / static_cast<std::size_t>(points_per_ring)];
    wrong += recovery.ring_of_point[i] != truth ? 1U : 0U;
  }
  return wrong;
}

TEST(RingRecovery, FindsEveryPointsRingFromTheOrderOfTheFile) {
  const auto points = synthetic::scan(synthetic::table());
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  EXPECT_EQ(recovery.rings, 64);
  EXPECT_EQ(recovery.no_ring, 0U);
  EXPECT_EQ(misplaced(recovery, 2000), 0U);
}

TEST(RingRecovery, StartsARingAtAPointStraightAheadEvenWithNegativeZero) {
  synthetic::World world;
  world.first_azimuth_deg = 0;
  auto points = synthetic::scan(synthetic::table(), world);
  for (ScanPoint& p : points) {
    if (p.y_m == 0.0F) p.y_m = -0.0F;
  }
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  EXPECT_EQ(misplaced(recovery, world.points_per_ring), 0U);
}

TEST(RingRecovery, KeepsPointsThatStepBackOverTheSeamInTheirRing) {
  auto points = synthetic::scan(synthetic::table());
  for (std::size_t ring = 1; ring < 64; ring += 3) {  // first point, last but one: swapped sides
    std::swap(points[ring * 2000], points[ring * 2000 + 1]);
    points[ring * 2000 + 1].y_m = -points[ring * 2000 + 1].y_m;
  }
  RingRecovery recovery;
  ASSERT_TRUE(split_into_rings(points, recovery));
  EXPECT_EQ(recovery.rings, 64);
  EXPECT_LE(misplaced(recovery, 2000), 21U);  // only the turned points themselves may be in doubt
}

TEST(RingRecovery, TakesAFirstPointJustBeforeStraightAheadAsPartOfTheFirstRing) {
  auto points = synthetic::scan(synthetic::table());
  points[0].y_m = -points[0].y_m;
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  EXPECT_EQ(recovery.rings, 64);
  EXPECT_EQ(misplaced(recovery, 2000), 0U);
}

TEST(RingRecovery, GivesPointsThatAreNoPlaceNoRing) {
  auto points = synthetic::scan(synthetic::table());
  points[0].x_m = std::numeric_limits<float>::quiet_NaN();
  points[4000].z_m = std::numeric_limits<float>::infinity();
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  EXPECT_EQ(recovery.no_ring, 2U);
  EXPECT_EQ(recovery.ring_of_point[0], kNoRing);
  EXPECT_EQ(recovery.ring_of_point[4000], kNoRing);
  EXPECT_EQ(misplaced(recovery, 2000), 2U);
}

TEST(RingRecovery, GivesNullPointsNoRingWhereverTheyStand) {
  auto points = synthetic::scan(synthetic::table());
  const auto null = [&](std::size_t first, std::size_t count) {
    std::fill_n(points.begin() + static_cast<std::ptrdiff_t>(first), count, ScanPoint{});
  };
  null(0, 1);                   // where the file begins
  null(7000, 1);                // inside a ring
  null(20 * 2000 - 500, 1000);  // a run over the end of a ring
  null(points.size() - 1, 1);   // where it ends
  null(40 * 2000 + 1999, 1);    // a ring's last
  points[40 * 2000 + 1999].remission = 0.5F;
  RingRecovery recovery;
  const Status status = recover_rings(points, nullptr, recovery);
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(recovery.rings, 64);
  EXPECT_EQ(recovery.no_ring, 1004U);
  EXPECT_EQ(misplaced(recovery, 2000), 1004U);
}

TEST(RingRecovery, TellsRingsOfAViewWithNothingStraightAhead) {
  const auto whole = synthetic::scan(synthetic::table());
  const auto left = synthetic::cropped(whole, [](double deg) { return deg > 0; });
  const auto behind = synthetic::cropped(whole, [](double deg) { return std::abs(deg) > 90; });
  const auto right_front =
      synthetic::cropped(whole, [](double deg) { return deg > -60 && deg < -10; });
  for (const auto& points : {left, behind, right_front}) {
    RingRecovery recovery;
    const Status status = recover_rings(points, nullptr, recovery);
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_EQ(recovery.rings, 64);
    EXPECT_EQ(misplaced(recovery, static_cast<int>(points.size() / 64)), 0U);
  }
}

TEST(RingRecovery, RingsThatLookTheSameWayAreNotOfOneLaser) {
  const RingTable table = synthetic::table();
  auto points = synthetic::scan(table);
  synthetic::erase_ring(points, 50);
  RingTable off = table;  // another unit's: 0.35 degrees off, more than half a ring below
  for (RingLine& ring : off) ring.elevation_rad -= beams::deg_to_rad(0.35);
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, &off, recovery));
  std::vector<int> rings;
  for (std::size_t i = 0; i < points.size(); i += 2000) rings.push_back(recovery.ring_of_point[i]);
  EXPECT_EQ(rings.size(), 63U);
  EXPECT_TRUE(std::ranges::is_sorted(rings));
  EXPECT_EQ(std::ranges::adjacent_find(rings), rings.end()) << "two lasers in one row";
}

TEST(RingRecovery, RefusesAFileThatIsSortedByColumns) {
  const RingTable table = synthetic::table();
  const auto rings = synthetic::scan(table);
  std::vector<ScanPoint> columns;
  for (std::size_t i = 0; i < 2000; ++i) {
    for (std::size_t ring = 0; ring < 64; ++ring) columns.push_back(rings[ring * 2000 + i]);
  }
  RingRecovery recovery;
  const Status status = recover_rings(columns, &table, recovery);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(status.error().message, HasSubstr("sort the points"));
  EXPECT_THAT(status.error().message, HasSubstr("--calibration"));
}

TEST(RingRecovery, AlignsByElevationWhereLasersHaveNoReturns) {
  const RingTable table = synthetic::table();
  auto points = synthetic::scan(table);
  for (const int ring : {63, 31, 7, 0}) synthetic::erase_ring(points, ring);
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, &table, recovery));
  EXPECT_EQ(recovery.rings, 64);
  EXPECT_EQ(recovery.no_ring, 0U);
  EXPECT_EQ(misplaced(recovery, 2000, {0, 7, 31, 63}), 0U);
}

TEST(RingRecovery, PutsARingTornInTwoTogetherAgain) {
  const RingTable table = synthetic::table();
  auto points = synthetic::scan(table);
  // Ring 20 ends at 216 degrees and begins again straight ahead: 65 rings by the order alone.
  const std::vector<ScanPoint> ring(points.begin() + 20 * 2000, points.begin() + 21 * 2000);
  for (std::size_t i = 1200; i < 2000; ++i) points[20 * 2000 + i] = ring[2 * (i - 1200)];
  RingRecovery split;
  ASSERT_TRUE(split_into_rings(points, split));
  ASSERT_EQ(split.rings, 65);
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, &table, recovery));
  EXPECT_EQ(misplaced(recovery, 2000), 0U);
}

TEST(RingRecovery, GivesARingThatNoLaserHasNoRing) {
  const RingTable table = synthetic::table();
  auto points = synthetic::scan(table);
  const std::size_t real = points.size();
  const RingLine odd{beams::deg_to_rad(-40), 0.1};  // 15 degrees below the lowest laser
  const auto extra = synthetic::scan({odd});
  points.insert(points.end(), extra.begin(), extra.end());
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, &table, recovery));
  EXPECT_EQ(recovery.no_ring, 2000U);
  EXPECT_EQ(recovery.ring_of_point[real], kNoRing);
}

TEST(RingRecovery, SaysThatMissingRingsNeedATable) {
  auto points = synthetic::scan(synthetic::table());
  synthetic::erase_ring(points, 5);
  RingRecovery recovery;
  const Status status = recover_rings(points, nullptr, recovery);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(status.error().message, HasSubstr("63 rings"));
  EXPECT_THAT(status.error().message, HasSubstr("give a calibration"));
}

TEST(RingRecovery, RefusesAShuffledScan) {
  auto points = synthetic::scan(synthetic::table());
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  RingRecovery recovery;
  const Status status = recover_rings(points, nullptr, recovery);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(status.error().message, HasSubstr("one after the other from the top"));
}

TEST(RingRecovery, RefusesAScanWithoutPoints) {
  RingRecovery recovery;
  EXPECT_FALSE(split_into_rings({}, recovery));
}

}  // namespace
}  // namespace terracut::scan
