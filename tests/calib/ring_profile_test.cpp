// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ring_profile.hpp"

#include <cmath>

#include "calib/angle.hpp"
#include "calib/nominal_hdl64e.hpp"
#include "calib/ring_profile_estimate.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::calib {
namespace {

std::vector<RingObservation> ground(int row, float range_m, int count) {
  return std::vector<RingObservation>(static_cast<std::size_t>(count), {row, range_m, true});
}

TEST(RingProfile, HasOneRingARowFromTheLowestUp) {
  const RingProfile profile = ring_profile(nominal_hdl64e(), Mount{});
  ASSERT_EQ(profile.rings.size(), 64U);
  for (std::size_t row = 1; row < 64; ++row) {
    EXPECT_GT(profile.rings[row].elevation_rad, profile.rings[row - 1].elevation_rad);
  }
  EXPECT_EQ(profile.mount.height_m, Mount{}.height_m);
}

TEST(RingProfile, MeetsTheGroundWhereTrigonometrySays) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  const auto lowest = static_cast<std::size_t>(
      std::min_element(calibration.lasers.begin(), calibration.lasers.end(),
                       [](const auto& a, const auto& b) {
                         return a.vert_correction_rad < b.vert_correction_rad;
                       }) -
      calibration.lasers.begin());
  calibration.lasers[lowest].vert_correction_rad = deg_to_rad(-26.565051177);  // 1 down, 2 out
  calibration.lasers[lowest].vert_offset_m = 0.2;
  const RingProfile profile = ring_profile(calibration, Mount{.height_m = 1.8});
  EXPECT_NEAR(profile.rings[0].ground_distance_m, 4.0, 1e-6);
  EXPECT_EQ(profile.rings[0].origin_height_m, 0.2);
}

TEST(RingProfile, RingsThatDoNotReachTheGroundInTimeAreInfinitelyFar) {
  const RingProfile profile = ring_profile(nominal_hdl64e(), Mount{}, 50.0);
  for (const Ring& ring : profile.rings) {
    const double meets_m =
        (Mount{}.height_m + ring.origin_height_m) / std::tan(-ring.elevation_rad);
    EXPECT_EQ(std::isinf(ring.ground_distance_m), ring.elevation_rad >= 0 || meets_m > 50.0);
  }
  EXPECT_TRUE(std::isinf(profile.rings[63].ground_distance_m));
  EXPECT_FALSE(std::isinf(profile.rings[0].ground_distance_m));
}

TEST(RingProfileEstimate, TakesTheMeanOfARingsGroundReturns) {
  const RingProfile geometry = ring_profile(nominal_hdl64e(), Mount{});
  RingProfileEstimate estimate(geometry, 10);
  const double d = geometry.rings[20].ground_distance_m;
  estimate.add(ground(20, static_cast<float>(d * 1.001), 30));
  estimate.add(ground(20, static_cast<float>(d * 0.997), 30));
  EXPECT_NEAR(estimate.profile().rings[20].ground_distance_m, d * 0.999, 1e-4);
  EXPECT_EQ(estimate.measured_rings(), 1);
}

TEST(RingProfileEstimate, FallsBackToGeometryWhereItSawTooLittle) {
  const RingProfile geometry = ring_profile(nominal_hdl64e(), Mount{});
  RingProfileEstimate estimate(geometry, 10);
  estimate.add(ground(20, static_cast<float>(geometry.rings[20].ground_distance_m * 1.001), 9));
  EXPECT_EQ(estimate.profile().rings[20].ground_distance_m, geometry.rings[20].ground_distance_m);
  EXPECT_EQ(estimate.measured_rings(), 0);
}

TEST(RingProfileEstimate, IgnoresObstaclesNonsenseAndPlanesElsewhere) {
  const RingProfile geometry = ring_profile(nominal_hdl64e(), Mount{});
  const auto d = static_cast<float>(geometry.rings[20].ground_distance_m);
  RingProfileEstimate estimate(geometry, 1);
  const RingObservation bad[] = {{20, d, false},       {-1, d, true},        {64, d, true},
                                 {20, NAN, true},      {20, INFINITY, true}, {20, d * 2, true},
                                 {20, d * 0.5F, true}, {63, 40.0F, true},    {20, -d, true}};
  estimate.add(bad);
  EXPECT_EQ(estimate.measured_rings(), 0);
}

TEST(RingProfileEstimate, ARingDoesNotOvertakeItsNeighbour) {
  const RingProfile geometry = ring_profile(nominal_hdl64e(), Mount{});
  RingProfileEstimate estimate(geometry, 1);
  estimate.add(ground(20, static_cast<float>(geometry.rings[22].ground_distance_m), 10));
  estimate.add(ground(5, static_cast<float>(geometry.rings[5].ground_distance_m * 1.001), 10));
  const RingProfile profile = estimate.profile();
  EXPECT_EQ(profile.rings[20].ground_distance_m, geometry.rings[20].ground_distance_m);
  EXPECT_NE(profile.rings[5].ground_distance_m, geometry.rings[5].ground_distance_m);
}

}  // namespace
}  // namespace terracut::calib
