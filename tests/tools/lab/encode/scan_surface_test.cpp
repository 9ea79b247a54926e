// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/scan_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "calib/beams/angle.hpp"

namespace terracut::encode {
namespace {

constexpr double kAzimuthStep_deg = 0.18;

double elevation_deg_of(int ring) {
  return 2.0 - 0.4 * ring;
}

/// A scan of 64 rings 0.4 degrees apart, from +2 to -23.2, all starting at the origin.
struct Scene {
  std::vector<scan::ScanPoint> points;
  std::vector<std::int16_t> rings;
  std::vector<std::uint32_t> labels;

  using Range = std::function<double(double azimuth_rad, double elevation_rad)>;
  using Label = std::function<std::uint32_t(double azimuth_rad, double elevation_rad)>;

  /// No return where the range is 0.
  explicit Scene(
      const Range& range_m, const Label& label = [](double, double) { return 50U; }) {
    for (int ring = 0; ring < 64; ++ring) {
      const double elevation = beams::deg_to_rad(elevation_deg_of(ring));
      for (int i = 0; i < 2000; ++i) {
        const double azimuth = beams::deg_to_rad(kAzimuthStep_deg * i);
        const double range = range_m(azimuth, elevation);
        if (range <= 0) continue;
        const double level = range * std::cos(elevation);
        points.push_back({static_cast<float>(level * std::cos(azimuth)),
                          static_cast<float>(-level * std::sin(azimuth)),
                          static_cast<float>(range * std::sin(elevation)), 0.5F});
        rings.push_back(static_cast<std::int16_t>(ring));
        labels.push_back(label(azimuth, elevation));
      }
    }
  }
  [[nodiscard]] ScanSurface surface(bool with_labels = true) const {
    ScanSurface made;
    made.take(points, rings, with_labels ? std::span(labels) : std::span<const std::uint32_t>());
    return made;
  }
};

double ground_m(double, double elevation_rad) {
  return elevation_rad < -0.02 ? -1.73 / std::sin(elevation_rad) : 0;
}
double wall_m(double azimuth_rad, double elevation_rad) {  // x = 20, ahead
  const double ahead = std::cos(azimuth_rad) * std::cos(elevation_rad);
  return ahead > 0.3 ? 20 / ahead : 0;
}

double deg(double degrees) {
  return beams::deg_to_rad(degrees);
}

TEST(ScanSurface, IsExactOnPlanesBetweenTheReturns) {
  const ScanSurface ground = Scene(ground_m, [](double, double) { return 40U; }).surface();
  const ScanSurface wall = Scene(wall_m).surface();
  for (double azimuth = 0.03; azimuth < 60; azimuth += 0.7) {
    for (double elevation = -20.05; elevation < -2.5; elevation += 0.37) {
      const auto on_ground = ground.look(deg(azimuth), deg(elevation));
      ASSERT_TRUE(on_ground) << azimuth << " " << elevation;
      EXPECT_NEAR(on_ground->range_m / ground_m(0, deg(elevation)), 1, 1e-4);
      const auto on_wall = wall.look(deg(azimuth), deg(elevation));
      ASSERT_TRUE(on_wall) << azimuth << " " << elevation;
      EXPECT_NEAR(on_wall->range_m / wall_m(deg(azimuth), deg(elevation)), 1, 1e-4);
    }
  }
}

TEST(ScanSurface, AnswersWithTheIndexOfTheNearestReturn) {
  const Scene scene(wall_m);
  const auto sight = scene.surface().look(deg(5 * 0.18 + 0.02), deg(elevation_deg_of(7) + 0.05));
  ASSERT_TRUE(sight);
  EXPECT_EQ(scene.rings[sight->point], 7);
  EXPECT_NEAR(scan::azimuth_rad(scene.points[sight->point].x_m, scene.points[sight->point].y_m),
              deg(5 * 0.18), 1e-6);
}

/// A post at 10 m, one degree wide, before a wall at 20 m.
Scene post(std::uint32_t label) {
  const auto on_post = [](double azimuth_rad) {
    return azimuth_rad > deg(9) && azimuth_rad < deg(10);
  };
  return Scene([=](double azimuth,
                   double elevation) { return on_post(azimuth) ? 10 : wall_m(azimuth, elevation); },
               [=](double azimuth, double) { return on_post(azimuth) ? label : 50U; });
}

TEST(ScanSurface, AtEdgesThereIsNothingBetweenTheSurfaces) {
  for (const bool with_labels : {true, false}) {
    const ScanSurface surface = post(80).surface(with_labels);
    std::size_t on_post = 0, on_wall = 0;
    for (double azimuth = 8.5; azimuth < 10.5; azimuth += 0.013) {
      const auto sight = surface.look(deg(azimuth), deg(-1.1));
      if (!sight) continue;
      const bool is_post = sight->range_m < 10.1;
      const double wall = wall_m(deg(azimuth), deg(-1.1));
      EXPECT_TRUE(is_post || std::abs(sight->range_m - wall) < 0.1) << sight->range_m;
      ++(is_post ? on_post : on_wall);
    }
    EXPECT_GT(on_post, 60U);
    EXPECT_GT(on_wall, 60U);
  }
}

TEST(ScanSurface, ThingsOfDifferentClassAreNotBlendedHoweverNearTheyAre) {
  const auto left = [](double azimuth_rad) { return azimuth_rad < deg(9.05); };
  const auto blended_beside_the_edge = [&](std::uint32_t a, std::uint32_t b) {
    const Scene scene([&](double azimuth, double) { return left(azimuth) ? 10.0 : 10.4; },
                      [&](double azimuth, double) { return left(azimuth) ? a : b; });
    const auto sight = scene.surface().look(deg(9.06), deg(-4.2));
    EXPECT_TRUE(sight);
    return sight && sight->range_m > 10.01 && sight->range_m < 10.39;
  };
  EXPECT_TRUE(blended_beside_the_edge(50, 50));
  EXPECT_FALSE(blended_beside_the_edge(10, 50));
  EXPECT_FALSE(blended_beside_the_edge(10 | 1U << 16, 10 | 2U << 16));  // two cars
  EXPECT_TRUE(blended_beside_the_edge(40, 48));                         // road and sidewalk
}

TEST(ScanSurface, SaysNothingWhereTheRecordingHasNothingNearBy) {
  const ScanSurface gap = Scene([](double azimuth, double elevation) {
                            const bool missing = azimuth > deg(20) && azimuth < deg(22);
                            return missing ? 0 : wall_m(azimuth, elevation);
                          }).surface();
  EXPECT_TRUE(gap.look(deg(19.9), deg(-3)));
  EXPECT_FALSE(gap.look(deg(21), deg(-3)));
  EXPECT_TRUE(gap.covers(deg(-3)));  // there are rings, only no returns
  EXPECT_FALSE(gap.look(deg(180), deg(-3)));

  EXPECT_FALSE(gap.look(deg(5), deg(3)));
  EXPECT_FALSE(gap.covers(deg(3)));
  EXPECT_TRUE(gap.look(deg(5), deg(2.2)));  // hardly above the top ring
  EXPECT_TRUE(gap.covers(deg(2.2)));
  EXPECT_FALSE(gap.look(deg(5), deg(-24.5)));
  EXPECT_FALSE(gap.covers(deg(-24.5)));
}

TEST(ScanSurface, AMissingRingIsAHoleAndNotBridged) {
  const double lost = elevation_deg_of(20);
  const ScanSurface surface =
      Scene([&](double azimuth, double elevation) {
        return std::abs(elevation - deg(lost)) < 1e-9 ? 0 : wall_m(azimuth, elevation);
      }).surface();
  EXPECT_FALSE(surface.look(deg(3), deg(lost)));
  EXPECT_TRUE(surface.look(deg(3), deg(lost + 0.5)));
}

TEST(ScanSurface, SeesAcrossTheSeam) {
  const ScanSurface surface = Scene(wall_m).surface();
  for (const double azimuth : {-0.09, -0.02, 0.0, 0.05, 359.99, 360.0, 719.93}) {
    const auto sight = surface.look(deg(azimuth), deg(-3.3));
    ASSERT_TRUE(sight) << azimuth;
    EXPECT_NEAR(sight->range_m, wall_m(deg(azimuth), deg(-3.3)), 1e-3);
  }
}

TEST(ScanSurface, ResetsTheScanBefore) {
  ScanSurface surface = Scene(wall_m).surface();
  const Scene behind([](double azimuth, double) { return std::cos(azimuth) < -0.5 ? 7.0 : 0.0; });
  surface.take(behind.points, behind.rings, behind.labels);
  EXPECT_FALSE(surface.look(deg(3), deg(-3)));
  ASSERT_TRUE(surface.look(deg(180), deg(-3)));
  surface.take({}, {}, {});
  EXPECT_FALSE(surface.look(deg(180), deg(-3)));
}

}  // namespace
}  // namespace terracut::encode
