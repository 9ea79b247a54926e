// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/azimuths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::frame {
namespace {

std::vector<float> azimuths_of(const std::vector<CloudPoint>& points) {
  std::vector<float> azimuths(points.size());
  find_azimuths(points, azimuths);
  return azimuths;
}

TEST(Azimuths, AreThoseOfTheStandardLibraryAllAround) {
  std::vector<CloudPoint> points;
  for (int i = 0; i < 100'000; ++i) {
    const double angle = 1e-4 * i, range_m = std::pow(10.0, i % 9 - 4);
    points.push_back({static_cast<float>(range_m * std::cos(angle)),
                      static_cast<float>(range_m * std::sin(angle)), 1, 0});
  }
  const auto azimuths = azimuths_of(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double expected = scan::azimuth_rad(double{points[i].x_m}, double{points[i].y_m});
    const double off = std::abs(double{azimuths[i]} - expected);
    ASSERT_LT(std::min(off, 2 * M_PI - off), 1e-6) << points[i].x_m << " " << points[i].y_m;
  }
}

TEST(Azimuths, OfTheAxesAndOfNegativeZerosAreExactlyWithinOneRevolution) {
  const auto azimuths = azimuths_of({{1, 0, 0, 0},
                                     {1, -0.0F, 0, 0},
                                     {0, -1, 0, 0},
                                     {-1, 0, 0, 0},
                                     {-1, -0.0F, 0, 0},
                                     {0, 1, 0, 0},
                                     {1, std::numeric_limits<float>::denorm_min(), 0, 0},
                                     {0, 0, 1, 0}});
  EXPECT_EQ(azimuths[0], 0);
  EXPECT_EQ(azimuths[1], 0);
  EXPECT_FLOAT_EQ(azimuths[2], static_cast<float>(M_PI / 2));
  EXPECT_FLOAT_EQ(azimuths[3], static_cast<float>(M_PI));
  EXPECT_FLOAT_EQ(azimuths[4], static_cast<float>(M_PI));
  EXPECT_FLOAT_EQ(azimuths[5], static_cast<float>(3 * M_PI / 2));
  EXPECT_EQ(azimuths[6], 0) << "rounds to a whole revolution";
  EXPECT_EQ(azimuths[7], 0) << "straight above there is no azimuth";
}

}  // namespace
}  // namespace terracut::frame
