// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/ring_profile.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "calib/beams/angle.hpp"
#include "calib/beams/straight_geometry.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/mount/ring_profile_estimate.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::mount {
namespace {

std::vector<RingObservation> ground(int row, float range_m, int count) {
  return std::vector<RingObservation>(static_cast<std::size_t>(count), {row, range_m, true});
}

TEST(RingProfile, HasOneRingARowFromTheLowestUp) {
  const RingProfile profile = ring_profile(hdl64e::nominal_hdl64e(), Mount{});
  ASSERT_EQ(profile.rings.size(), 64U);
  for (std::size_t row = 1; row < 64; ++row) {
    EXPECT_GT(profile.rings[row].elevation_rad, profile.rings[row - 1].elevation_rad);
  }
  EXPECT_EQ(profile.mount.height_m, Mount{}.height_m);
}

TEST(RingProfile, OfASensorUpsideDownIsTurnedOver) {
  const Mount hanging{.height_m = 1.8, .roll_rad = std::numbers::pi};
  const RingProfile profile = ring_profile(ruby128::nominal_ruby128(), hanging);
  const RingProfile standing = ring_profile(ruby128::nominal_ruby128(), Mount{.height_m = 1.8});
  for (std::size_t row = 0; row < profile.rings.size(); ++row) {
    const Ring& ring = profile.rings[row];
    const double elevation_rad = standing.rings[profile.rings.size() - 1 - row].elevation_rad;
    EXPECT_EQ(ring.elevation_rad, -elevation_rad);
    EXPECT_EQ(std::isfinite(ring.ground_distance_m), elevation_rad > beams::deg_to_rad(0.9));
  }
}

TEST(RingProfile, OfASensorUpsideDownThatLeansMeetsTheGroundWhereItLooksDown) {
  const Mount hanging{1.8, beams::deg_to_rad(150), 0};
  for (const Ring& ring : ring_profile(hdl64e::nominal_hdl64e(), hanging).rings) {
    EXPECT_LT(ring.ground_distance_m, 40) << ring.elevation_rad;
  }
}

TEST(RingProfile, MeetsTheGroundWhereTrigonometrySays) {
  hdl64e::Hdl64eCalibration calibration = hdl64e::nominal_hdl64e();
  const auto lowest = static_cast<std::size_t>(
      std::min_element(calibration.lasers.begin(), calibration.lasers.end(),
                       [](const auto& a, const auto& b) {
                         return a.vert_correction_rad < b.vert_correction_rad;
                       }) -
      calibration.lasers.begin());
  calibration.lasers[lowest].vert_correction_rad =
      beams::deg_to_rad(-26.565051177);  // 1 down, 2 out
  calibration.lasers[lowest].vert_offset_m = 0.2;
  const RingProfile profile = ring_profile(calibration, Mount{.height_m = 1.8});
  EXPECT_NEAR(profile.rings[0].ground_distance_m, 4.0, 1e-6);
  EXPECT_EQ(profile.rings[0].origin_height_m, 0.2);
}

TEST(RingProfile, RingsThatDoNotReachTheGroundInTimeAreInfinitelyFar) {
  const RingProfile profile = ring_profile(hdl64e::nominal_hdl64e(), Mount{}, 50.0);
  for (const Ring& ring : profile.rings) {
    const double meets_m =
        (Mount{}.height_m + ring.origin_height_m) / std::tan(-ring.elevation_rad);
    EXPECT_EQ(std::isinf(ring.ground_distance_m), ring.elevation_rad >= 0 || meets_m > 50.0);
  }
  EXPECT_TRUE(std::isinf(profile.rings[63].ground_distance_m));
  EXPECT_FALSE(std::isinf(profile.rings[0].ground_distance_m));
}

TEST(RingProfile, OfARubyMeetsTheGroundWhereItsReturnsDo) {
  const ruby128::Ruby128Calibration calibration = ruby128::nominal_ruby128();
  const beams::StraightGeometry geometry(calibration.channels, ruby128::kRuby128MetresPerCount,
                                         ruby128::kRuby128LensAhead_m);
  const Mount mount{.height_m = 1.9};
  const RingProfile profile = ring_profile(calibration, mount, 120.0);
  ASSERT_EQ(profile.rings.size(), 128U);
  const auto rows = rows_by_elevation(calibration);
  int reaching = 0;
  for (int channel = 0; channel < ruby128::kRuby128Lasers; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    const Ring& ring = profile.rings[static_cast<std::size_t>(rows[c])];
    EXPECT_EQ(ring.elevation_rad, calibration.channels[c].elevation_rad);
    EXPECT_EQ(ring.origin_height_m, 0.0);
    const auto raw = geometry.raw_on_plane(channel, 0.3, {0, 0, -1.9}, {0, 0, 1});
    const beams::Point ground = geometry.point(channel, 0.3, raw.value_or(0));
    const double distance_m = std::hypot(ground.x_m, ground.y_m);
    const bool reaches = raw.has_value() && distance_m <= 120.0;
    EXPECT_EQ(std::isfinite(ring.ground_distance_m), reaches) << channel;
    if (!reaches) continue;
    EXPECT_NEAR(ring.ground_distance_m, distance_m, 1e-9) << channel;
    ++reaching;
  }
  EXPECT_EQ(reaching, 68);  // 13 coarse rows, then -6.39 to -0.99 degrees by tenths
}

TEST(RingProfile, OfARubyEndsWhereItsReturnsWouldLieBeyondTheLimit) {
  // The limit is that of the place on the ground, not of the way from the lens to it.
  const ruby128::Ruby128Calibration calibration = ruby128::nominal_ruby128();
  const double ring_m = ring_profile(calibration, Mount{}).rings[30].ground_distance_m;
  ASSERT_TRUE(std::isfinite(ring_m));
  for (const double beyond_m : {-0.001, 0.001}) {
    const RingProfile profile = ring_profile(calibration, Mount{}, ring_m + beyond_m);
    EXPECT_EQ(std::isfinite(profile.rings[30].ground_distance_m), beyond_m > 0);
  }
}

TEST(RingProfileEstimate, TakesTheMeanOfARingsGroundReturns) {
  const RingProfile geometry = ring_profile(hdl64e::nominal_hdl64e(), Mount{});
  RingProfileEstimate estimate(geometry, 10);
  const double d = geometry.rings[20].ground_distance_m;
  estimate.add(ground(20, static_cast<float>(d * 1.001), 30));
  estimate.add(ground(20, static_cast<float>(d * 0.997), 30));
  EXPECT_NEAR(estimate.profile().rings[20].ground_distance_m, d * 0.999, 1e-4);
  EXPECT_EQ(estimate.measured_rings(), 1);
}

TEST(RingProfileEstimate, FallsBackToGeometryWhereItSawTooLittle) {
  const RingProfile geometry = ring_profile(hdl64e::nominal_hdl64e(), Mount{});
  RingProfileEstimate estimate(geometry, 10);
  estimate.add(ground(20, static_cast<float>(geometry.rings[20].ground_distance_m * 1.001), 9));
  EXPECT_EQ(estimate.profile().rings[20].ground_distance_m, geometry.rings[20].ground_distance_m);
  EXPECT_EQ(estimate.measured_rings(), 0);
}

TEST(RingProfileEstimate, IgnoresObstaclesNonsenseAndPlanesElsewhere) {
  const RingProfile geometry = ring_profile(hdl64e::nominal_hdl64e(), Mount{});
  const auto d = static_cast<float>(geometry.rings[20].ground_distance_m);
  RingProfileEstimate estimate(geometry, 1);
  const RingObservation bad[] = {{20, d, false},       {-1, d, true},        {64, d, true},
                                 {20, NAN, true},      {20, INFINITY, true}, {20, d * 2, true},
                                 {20, d * 0.5F, true}, {63, 40.0F, true},    {20, -d, true}};
  estimate.add(bad);
  EXPECT_EQ(estimate.measured_rings(), 0);
}

TEST(RingProfileEstimate, IgnoresPlanesMoreThanHalfNearerOrFartherThanTheGeometrys) {
  // Of one ring, which has no neighbour to be compared with.
  const RingProfile geometry{{{-0.1, 0, 30.0}}, Mount{}};
  for (const auto& [range_m, is_taken] :
       {std::pair{19.9F, false}, {20.1F, true}, {44.9F, true}, {45.1F, false}}) {
    RingProfileEstimate estimate(geometry, 1);
    estimate.add(ground(0, range_m, 10));
    EXPECT_EQ(estimate.measured_rings(), is_taken ? 1 : 0) << range_m;
  }
}

TEST(RingProfileEstimate, ARingDoesNotOvertakeItsNeighbour) {
  const RingProfile geometry = ring_profile(hdl64e::nominal_hdl64e(), Mount{});
  RingProfileEstimate estimate(geometry, 1);
  estimate.add(ground(20, static_cast<float>(geometry.rings[22].ground_distance_m), 10));
  estimate.add(ground(21, static_cast<float>(geometry.rings[21].ground_distance_m * 1.001), 10));
  estimate.add(ground(5, static_cast<float>(geometry.rings[5].ground_distance_m * 1.001), 10));
  const RingProfile profile = estimate.profile();
  EXPECT_EQ(profile.rings[20].ground_distance_m, geometry.rings[20].ground_distance_m);
  EXPECT_EQ(profile.rings[21].ground_distance_m, geometry.rings[21].ground_distance_m);
  EXPECT_NE(profile.rings[5].ground_distance_m, geometry.rings[5].ground_distance_m);
}

}  // namespace
}  // namespace terracut::mount
