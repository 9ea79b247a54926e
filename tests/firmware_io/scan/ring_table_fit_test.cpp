// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/ring_table_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "firmware_io/scan/line_fit.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "synthetic_scan.hpp"

namespace terracut::scan {
namespace {

FittedRings fitted(const std::vector<ScanPoint>& points, std::vector<std::int16_t> rings = {}) {
  if (rings.empty()) {
    RingRecovery recovery;
    EXPECT_TRUE(recover_rings(points, nullptr, recovery));
    rings = recovery.ring_of_point;
  }
  RingTableFit fit;
  fit.add(points, rings);
  auto result = fit.fit();
  EXPECT_TRUE(result) << result.error().message;
  return result.value_or(FittedRings{});
}

void expect_near(const RingTable& found, const RingTable& truth, double elevation_deg,
                 double offset_m) {
  for (std::size_t ring = 0; ring < truth.size(); ++ring) {
    EXPECT_NEAR(beams::rad_to_deg(found[ring].elevation_rad),
                beams::rad_to_deg(truth[ring].elevation_rad), elevation_deg)
        << "ring " << ring;
    EXPECT_NEAR(found[ring].vert_offset_m, truth[ring].vert_offset_m, offset_m) << "ring " << ring;
  }
}

TEST(LineFit, IsExactOnALine) {
  const std::vector<LinePoint> points{{1, 3}, {2, 5}, {4, 9}};
  const FittedLine line = fit_line(points, 0.05);
  EXPECT_NEAR(line.slope, 2, 1e-9);
  EXPECT_NEAR(line.offset, 1, 1e-9);
}

TEST(LineFit, FindsALevelLine) {
  const std::vector<LinePoint> points{{1, 3}, {2, 3}, {4, 3}};
  EXPECT_NEAR(fit_line(points, 0.05).slope, 0, 1e-12);
}

TEST(LineFit, IsNotFlattenedByErrorsInDistance) {
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, 0.3);
  std::uniform_real_distribution<double> distance(3, 5);
  std::vector<LinePoint> points;
  for (int i = 0; i < 20000; ++i) {
    const double x = distance(random);
    points.push_back({x + error(random), 0.1 - 0.45 * x});
  }
  // A regression of y on x would find -0.45 * var(x) / (var(x) + 0.09) = -0.35.
  EXPECT_NEAR(fit_line(points, 0.05).slope, -0.45, 0.01);
}

TEST(LineFit, IgnoresOutliers) {
  std::vector<LinePoint> points;
  for (int i = 0; i < 1000; ++i) points.push_back({i * 0.01, i * 0.02});
  for (int i = 0; i < 100; ++i) points.push_back({i * 0.1, 8.0});
  EXPECT_NEAR(fit_line(points, 0.05).slope, 2, 0.01);
}

TEST(LineFit, IsNotDrawnToAFewPointsThatHappenToLieOnALine) {
  // 1 + 2 x with errors of up to 0.5. Weighed without regard to how far points lie from the line,
  // a few of them decide, and the slope is 2.17.
  const std::vector<LinePoint> points{{0, 1.3}, {1, 3.5},  {2, 4.5},  {3, 6.7},
                                      {4, 8.7}, {5, 10.8}, {6, 13.2}, {7, 15.4}};
  EXPECT_NEAR(fit_line(points, 50).slope, 2, 0.05);
}

TEST(RingTableFit, FindsTheTableAScanWasMadeWith) {
  const RingTable truth = synthetic::table();
  const FittedRings found = fitted(synthetic::scan(truth));
  expect_near(found.table, truth, 0.002, 0.0005);
  EXPECT_LT(found.residual.rms_m, 1e-4);
  EXPECT_EQ(found.residual.points, 64U * 2000U);
}

TEST(RingTableFit, FindsItThroughMotionCompensation) {
  const RingTable truth = synthetic::table();
  auto points = synthetic::scan(truth);
  for (ScanPoint& p : points) {  // 10 m/s, shifted by up to half a metre
    const double share = std::atan2(-p.y_m, p.x_m) / (2 * std::numbers::pi);
    p.x_m += static_cast<float>(1.0 * share);
  }
  const FittedRings found = fitted(points);
  expect_near(found.table, truth, 0.8, 0.08);
  EXPECT_LT(found.residual.p95_m, 0.15);
  EXPECT_GT(found.residual.p95_m, 0.02);  // it cannot explain what the compensation did
}

TEST(RingTableFit, PutsRingsWithFewPointsBetweenTheirNeighbours) {
  const RingTable truth = synthetic::table();
  const auto points = synthetic::scan(truth);
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  for (auto& ring : recovery.ring_of_point) {
    if (ring == 0 || ring == 10 || ring == 11 || ring == 63) ring = kNoRing;
  }
  const FittedRings found = fitted(points, recovery.ring_of_point);
  expect_near(found.table, truth, 0.05, 0.001);
}

TEST(RingTableFit, LeavesPointsOutThatNoSensorReaches) {
  const RingTable truth = synthetic::table();
  auto points = synthetic::scan(truth);
  points[5 * 2000 + 7] = {9000, 1, 9000, 0};
  points[9 * 2000 + 7].z_m = std::numeric_limits<float>::quiet_NaN();
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  const FittedRings found = fitted(points, recovery.ring_of_point);
  EXPECT_EQ(found.residual.points, 64U * 2000U - 2U);
  expect_near(found.table, truth, 0.002, 0.0005);
}

TEST(RingTableFit, RefusesTooFewPoints) {
  RingTableFit fit;
  const auto result = fit.fit();
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, testing::HasSubstr("only 0 of 64 rings"));
}

TEST(RingTableFit, TakesLinesOfTheRingsThatSawSomethingWhereMostSawNothing) {
  // An open field: what looks above the horizon returns nothing, but for a little that is near it.
  RingTable truth;
  for (int ring = 0; ring < 64; ++ring) truth.push_back({beams::deg_to_rad(22.5 - ring * 0.7), 0});
  std::vector<ScanPoint> points;
  std::vector<std::int16_t> rings;
  for (std::size_t ring = 28; ring < truth.size(); ++ring) {
    const double slope = std::tan(truth[ring].elevation_rad);
    for (int i = 0; i < (ring < 34 ? 7 : 90); ++i) {
      const double distance_m = ring < 34 ? 8 : 1.7 / -slope;
      points.push_back({static_cast<float>(distance_m * std::cos(i * 0.01)),
                        static_cast<float>(distance_m * std::sin(i * 0.01)),
                        static_cast<float>(distance_m * slope), 0});
      rings.push_back(static_cast<std::int16_t>(ring));
    }
  }
  RingTableFit fit(64);
  fit.add(points, rings);
  EXPECT_FALSE(fit.fit()) << "no ring has a hundred points";
  const auto found = fit.fit_seen(RingTable(64));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->with_line, 30U);
  EXPECT_EQ(found->coinciding, 0U);
  expect_near(found->table, truth, 0.05, 1e-9);
}

TEST(RingTableFit, PutsRingsWithoutPointsNoStraighterUpThanALaserLooks) {
  RingTable truth;
  for (int ring = 0; ring < 6; ++ring) truth.push_back({beams::deg_to_rad(-5.0 * ring), 0});
  std::vector<ScanPoint> points;
  std::vector<std::int16_t> rings;
  for (std::size_t ring = 0; ring < truth.size(); ++ring) {
    const auto z_m = static_cast<float>(10 * std::tan(truth[ring].elevation_rad));
    for (int i = 0; i < 20; ++i) {
      points.push_back({10, 0, z_m, 0});
      rings.push_back(static_cast<std::int16_t>(90 + ring));
    }
  }
  RingTableFit fit(200);
  fit.add(points, rings);
  const auto found = fit.fit_seen(RingTable(200));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(found->table.front().elevation_rad, beams::deg_to_rad(90));
  EXPECT_GT(found->table.back().elevation_rad, beams::deg_to_rad(-90));
  for (std::size_t ring = 0; ring < truth.size(); ++ring) {
    EXPECT_NEAR(found->table[90 + ring].elevation_rad, truth[ring].elevation_rad, 1e-4);
  }
}

TEST(RingTableFit, CountsRingsThatLookTheSameWay) {
  std::vector<ScanPoint> points;
  std::vector<std::int16_t> rings;
  for (std::int16_t ring = 0; ring < 16; ++ring) {
    for (int i = 0; i < 100; ++i) {
      points.push_back({10, static_cast<float>(i), 0, 0});
      rings.push_back(ring);
    }
  }
  RingTableFit fit(16);
  fit.add(points, rings);
  const auto found = fit.fit();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->coinciding, 15U);
}

TEST(RingTableFit, ThinsOutManyScansEvenly) {
  const RingTable truth = synthetic::table();
  const auto points = synthetic::scan(truth);
  RingRecovery recovery;
  ASSERT_TRUE(recover_rings(points, nullptr, recovery));
  RingTableFit fit;
  for (int i = 0; i < 70; ++i) fit.add(points, recovery.ring_of_point);
  const auto found = fit.fit();
  ASSERT_TRUE(found);
  EXPECT_LE(found->by_ring[3].points, RingTableFit::kPointsPerRing);
  EXPECT_GE(found->by_ring[3].points, RingTableFit::kPointsPerRing / 2);
  expect_near(found->table, truth, 0.002, 0.0005);
}

TEST(RingTable, GoesToACalibrationAndBack) {
  const RingTable truth = synthetic::table();
  const hdl64e::Hdl64eCalibration calibration = hdl64e_calibration(truth);
  EXPECT_TRUE(validate(calibration));
  expect_near(ring_table(calibration), truth, 1e-9, 1e-9);
  const auto lasers = lasers_by_ring(calibration);
  for (int ring = 0; ring < kScanRings; ++ring) {
    EXPECT_EQ(lasers[static_cast<std::size_t>(ring)], usual_laser_of_ring(ring));
  }
}

TEST(RingTable, NumbersLasersLikeMostUnits) {
  std::set<int> lasers;
  for (int ring = 0; ring < kScanRings; ++ring) lasers.insert(usual_laser_of_ring(ring));
  EXPECT_EQ(lasers.size(), 64U);
  EXPECT_EQ(usual_laser_of_ring(0), 29);   // formats of real units: the top beam is laser 29,
  EXPECT_EQ(usual_laser_of_ring(63), 38);  // the lowest one laser 38
}

}  // namespace
}  // namespace terracut::scan
