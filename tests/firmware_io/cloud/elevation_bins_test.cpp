// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/elevation_bins.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <vector>

#include "calib/beams/angle.hpp"

namespace terracut::cloud {
namespace {

using beams::deg_to_rad;
using scan::ScanPoint;
using testing::HasSubstr;

constexpr double kSensorHeight_m = 1.7, kWall_m = 25;

struct FieldOfView {
  double half_width_deg = 35, lowest_deg = -30, highest_deg = 10;
};

/// Points in random directions of a field of view: level ground with a wall behind it.
std::vector<ScanPoint> scattered(std::size_t points, const FieldOfView& view,
                                 double origin_above_ground_m = kSensorHeight_m) {
  std::vector<ScanPoint> cloud;
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  while (cloud.size() < points) {
    const double azimuth_rad = deg_to_rad(between(-view.half_width_deg, view.half_width_deg));
    const double slope = std::tan(deg_to_rad(between(view.lowest_deg, view.highest_deg)));
    const double distance_m =
        slope < -kSensorHeight_m / kWall_m ? kSensorHeight_m / -slope : kWall_m;
    const double z_m = distance_m * slope + kSensorHeight_m - origin_above_ground_m;
    cloud.push_back({static_cast<float>(distance_m * std::cos(azimuth_rad)),
                     static_cast<float>(distance_m * std::sin(azimuth_rad)),
                     static_cast<float>(z_m), 0});
  }
  return cloud;
}

Expected<SensorRows> binned(const CloudView& cloud) {
  return bin_elevations(1, [&](std::size_t) -> Expected<CloudView> { return cloud; });
}

Expected<SensorRows> learnt(const CloudView& cloud) {
  return learn_rows_or_bins(1, [&](std::size_t) -> Expected<CloudView> { return cloud; });
}

TEST(ElevationBins, AreSquareAndAsManyAsPointsFillTheFieldOfView) {
  // 70 x 40 degrees in 28,000 points: a tenth of a square degree each, 0.316 degrees apart.
  const auto rows = binned({scattered(28'000, {})});
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(rows->source, RowSource::kElevationBins);
  EXPECT_NEAR(static_cast<double>(rows->rings.table.size()), 40 / 0.316, 6);
  EXPECT_NEAR(rows->columns, 360 / 0.316, 60);
  EXPECT_NEAR(rows->rings.table.front().elevation_rad, deg_to_rad(10), deg_to_rad(0.4));
  EXPECT_NEAR(rows->rings.table.back().elevation_rad, deg_to_rad(-30), deg_to_rad(0.4));
  EXPECT_EQ(rows->viewpoint_above_m, 0);
}

TEST(ElevationBins, AreNeverMoreThanRowsOfASensor) {
  const auto rows = binned({scattered(400'000, {})});
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(rows->rings.table.size(), static_cast<std::size_t>(kMostLasers));
}

TEST(ElevationBins, AreSeenFromAboveWhereTheOriginLiesOnTheGround) {
  const auto cloud = scattered(28'000, {.half_width_deg = 180}, 0.05);
  const auto rows = binned({cloud});
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_NEAR(rows->viewpoint_above_m, 1.75, 0.02);
  EXPECT_NEAR(rows->rings.table.front().elevation_rad, deg_to_rad(10), deg_to_rad(1));

  scan::RingRecovery found;
  ASSERT_TRUE(RowFinder(*rows).find({cloud}, found));
  EXPECT_LT(found.no_ring, cloud.size() / 500);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (found.ring_of_point[i] == scan::kNoRing) continue;
    const auto ring = static_cast<std::size_t>(found.ring_of_point[i]);
    const double seen_rad =
        std::atan2(cloud[i].z_m - rows->viewpoint_above_m, std::hypot(cloud[i].x_m, cloud[i].y_m));
    ASSERT_NEAR(seen_rad, rows->rings.table[ring].elevation_rad, deg_to_rad(1)) << i;
  }
}

TEST(ElevationBins, AreRefusedForFewPointsAndForThoseOfOnePlane) {
  const auto few = binned({scattered(999, {})});
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(few.error().message, HasSubstr("999 points in 1 clouds; expected 1000 or more"));

  const auto level = binned({scattered(5000, {.lowest_deg = 1, .highest_deg = 1.1})});
  ASSERT_FALSE(level);
  EXPECT_EQ(level.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(level.error().message, HasSubstr("all points lie between 1.00 and 1.10 degrees"));
}

TEST(ElevationBins, AreTakenOnlyWhereNoLasersShow) {
  const auto cloud = scattered(28'000, {});
  const auto no_lasers = learnt({cloud});
  ASSERT_TRUE(no_lasers) << no_lasers.error().message;
  EXPECT_EQ(no_lasers->source, RowSource::kElevationBins);
  EXPECT_THAT(no_lasers->no_lasers, HasSubstr("nothing tells which laser measured a point"));

  std::vector<ScanPoint> rows;
  std::vector<std::uint16_t> laser;
  for (int i = 0; i < 32 * 900; ++i) {
    const double slope = std::tan(deg_to_rad(i / 900 - 20));
    const double distance_m = slope < -0.1 ? kSensorHeight_m / -slope : 17;
    const double azimuth_rad = deg_to_rad(0.4 * (i % 900));
    rows.push_back({static_cast<float>(distance_m * std::cos(azimuth_rad)),
                    static_cast<float>(distance_m * std::sin(azimuth_rad)),
                    static_cast<float>(distance_m * slope), 0});
    laser.push_back(static_cast<std::uint16_t>(i / 900));
  }
  EXPECT_EQ(learnt({rows, laser})->source, RowSource::kLaserNumbers);
  for (ScanPoint& point : rows) point.x_m += 20;  // a map's frame: no cones around the origin
  const auto moved = learnt({rows, laser});
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(moved->source, RowSource::kElevationBins);
  EXPECT_THAT(moved->no_lasers, HasSubstr("look the same way as the one above them"));
}

TEST(ElevationBins, AreRefusedWithTheReasonOfTheLasersWhereNeitherCanBeHad) {
  const auto rows = learnt({scattered(500, {})});
  ASSERT_FALSE(rows);
  EXPECT_THAT(rows.error().message, HasSubstr("nothing tells which laser measured a point"));
}

}  // namespace
}  // namespace terracut::cloud
