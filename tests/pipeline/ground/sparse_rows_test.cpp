// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/sparse_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::ground {
namespace {

double gap_deg(const mount::RingProfile& profile) {
  return beams::rad_to_deg(row_gap_rad(profile));
}

TEST(RowGap, IsThatOfTheRowsThatMeetTheGroundSomeTensOfMetresAway) {
  EXPECT_NEAR(gap_deg(test::even_profile(16, -15, 15)), 2, 1e-9);
  EXPECT_NEAR(gap_deg(test::even_profile(53, -24, 2)), 0.5, 1e-9);
  // Wide apart where they look down beside the vehicle and at the sky, and dense in between.
  mount::RingProfile profile;
  for (const double deg : {-25.0, -15.0, -9.0, -8.7, -8.4, -4.0, -3.7, 3.0, 15.0}) {
    profile.rings.push_back({beams::deg_to_rad(deg), 0, 0});
  }
  EXPECT_NEAR(gap_deg(profile), 0.3, 1e-9);
  EXPECT_EQ(row_gap_rad(test::even_profile(2, -1, 2)), std::numeric_limits<double>::infinity());
}

TEST(SparseRows, AreNoneOfTheTwoSensorsWithPackets) {
  const SegmenterConfig config = terracut_profile();
  for (const mount::RingProfile& profile : {mount::ring_profile(hdl64e::nominal_hdl64e(), {}),
                                            mount::ring_profile(ruby128::nominal_ruby128(), {})}) {
    EXPECT_LT(gap_deg(profile), 0.4);
    const SegmenterConfig suited = suited_to_rows(config, profile);
    EXPECT_EQ(suited.elevation_map.surface.step_up_limit_m,
              config.elevation_map.surface.step_up_limit_m);
    EXPECT_EQ(suited.elevation_map.surface.regain_gap_m, config.elevation_map.surface.regain_gap_m);
    EXPECT_EQ(suited.adjacent_points.min_lower_height_m, config.adjacent_points.min_lower_height_m);
  }
}

/// Level ground, a car 25 m ahead of which two beams of 16 see the flank, the lower one 0.33 m
/// above the ground, and the front of a house 15 m behind it.
test::BeamCast car_before_a_house() {
  const auto car = test::ground_with_wall(25, 0.9, 1.4, 0.2);
  const auto house = test::ground_with_wall(40, 20, 6);
  return [=](double azimuth_rad, double elevation_rad) {
    const double to_car_m = car(azimuth_rad, elevation_rad);
    const double to_house_m = house(azimuth_rad, elevation_rad);
    if (to_car_m > 0 && to_house_m > 0) return std::min(to_car_m, to_house_m);
    return to_car_m > 0 ? to_car_m : to_house_m;
  };
}

TEST(SparseRows, LabelTheOnlyReturnOfACarsFootAsObstacle) {
  const frame::ImageShape shape{16, 2000};
  const mount::RingProfile profile = test::even_profile(shape.rows, -24, 2);
  const auto obstacles_of_flank = [&](const SegmenterConfig& config) {
    memory::FixedMemory memory;
    frame::RangeImage image(shape, 100, memory);
    Segmenter segmenter(config, profile, shape, image.return_capacity(), memory);
    test::cast_frame(profile, car_before_a_house(), image);
    (void)segmenter.segment(image);
    int flank = 0, obstacles = 0;
    for (std::size_t cell = 0; cell < shape.cells(); ++cell) {
      if (!image.has_return(cell) || std::fabs(image.x_m()[cell] - 25) > 0.01 ||
          std::fabs(image.y_m()[cell]) > 0.9F || image.z_m()[cell] < 0.2F) {
        continue;
      }
      ++flank;
      obstacles += segmenter.labels()[image.return_index()[cell]] == frame::Label::kObstacle;
    }
    EXPECT_GT(flank, 20);
    return static_cast<double>(obstacles) / flank;
  };
  EXPECT_EQ(obstacles_of_flank(terracut_profile()), 1.0);
  SegmenterConfig as_if_dense = terracut_profile();
  as_if_dense.sparse.from_deg = 90;
  EXPECT_LT(obstacles_of_flank(as_if_dense), 0.7) << "what this is about";
}

}  // namespace
}  // namespace terracut::ground
