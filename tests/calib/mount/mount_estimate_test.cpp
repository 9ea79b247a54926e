// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_estimate.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "calib/beams/angle.hpp"
#include "tests/calib/calib_test_support.hpp"
#include "tests/calib/mount/sensor_view.hpp"

namespace terracut::mount {
namespace {

using testing::HasSubstr;
using Cloud = std::vector<std::array<float, 3>>;

class Scene : public test::SensorView {
 public:
  using SensorView::SensorView;

  /// The lane out to 15 m, as dense as rings make it, between the walls of an archway, with the
  /// boot and the roof of a car ahead.
  void add_street(double noise_m) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, noise_m);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 12000; ++i) {
      const double range_m = 2.5 + 22.5 * share(random) * share(random);
      add(i % 2 == 0 ? range_m : -range_m, 3 * share(random) - 1.5, noise(random));
    }
    for (int i = 0; i < 3000; ++i) {  // walls left and right
      add(-20 + 40 * share(random), i % 2 == 0 ? 1.45 : -1.45, 6 * share(random));
    }
    for (int i = 0; i < 4000; ++i) {  // hides nothing, for it is denser than it would be
      const bool is_roof = i % 3 == 0;
      add(is_roof ? 7 + 3 * share(random) : 7, 1.8 * share(random) - 0.9,
          is_roof ? 1.45 : 0.4 + share(random));
    }
  }
};

/// The strip of a recorded scan.
Cloud strip_of_scan(const std::filesystem::path& path) {
  const std::string bytes = test::content_of(path);
  Cloud points(bytes.size() / 16);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::copy_n(bytes.data() + 16 * i, 12, reinterpret_cast<char*>(points[i].data()));
  }
  std::erase_if(points, [](const auto& p) { return std::abs(p[1]) > 1.5F; });
  return points;
}

TEST(MountEstimate, FindsHeightRollAndPitchAmongWallsAndCars) {
  for (const double height_m : {0.8, 1.73, 3.0}) {
    for (const double pitch_deg : {-5.0, 0.0, 3.0}) {
      for (const double roll_deg : {-2.0, 0.0, 5.0}) {
        const Mount mount{height_m, beams::deg_to_rad(roll_deg), beams::deg_to_rad(pitch_deg)};
        Scene scene(mount);
        scene.add_street(0.02);
        const auto found = estimate_mount(scene.points());
        ASSERT_TRUE(found.has_value()) << found.error().message;
        EXPECT_NEAR(found->mount.height_m, height_m, 0.03);
        EXPECT_NEAR(beams::rad_to_deg(found->mount.roll_rad), roll_deg, 0.3);
        EXPECT_NEAR(beams::rad_to_deg(found->mount.pitch_rad), pitch_deg, 0.3);
      }
    }
  }
}

TEST(MountEstimate, IsExactOnAPerfectPlane) {
  const Mount mount{2.0, beams::deg_to_rad(1.5), beams::deg_to_rad(-2.5)};
  Scene scene(mount);
  for (int x = -20; x <= 20; ++x) {
    for (double y = -1.5; y <= 1.5; y += 0.25) scene.add(x, y, 0);
  }
  const auto found = estimate_mount(scene.points());
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_NEAR(found->mount.height_m, 2.0, 1e-5);
  EXPECT_NEAR(found->mount.roll_rad, mount.roll_rad, 1e-6);
  EXPECT_NEAR(found->mount.pitch_rad, mount.pitch_rad, 1e-6);
}

TEST(MountEstimate, IsTheOneBelowTheSensorWhereASlopeBegins) {
  const auto rise_m = [](double x) { return 0.0033 * x * x; };  // 0 to 15 % within 23 m
  for (const double pitch_deg : {-5.0, 0.0, 5.0}) {
    const Mount mount{3.0, 0, beams::deg_to_rad(pitch_deg)};
    Scene scene(mount);
    for (double y = -1.4; y < 1.5; y += 0.2) {
      for (double x = 3; x < 15; x += 0.2) scene.add(-x, y, rise_m(x));
      // A sensor with its rows about the horizon sees far more of what is far.
      for (double x = 3; x < 15; x += x < 10 ? 0.2 : 0.02) scene.add(x, y, rise_m(x));
    }
    const auto found = estimate_mount(scene.points());
    ASSERT_TRUE(found.has_value()) << found.error().message;
    EXPECT_NEAR(found->mount.height_m, 3.0, 0.01);
    EXPECT_NEAR(beams::rad_to_deg(found->mount.roll_rad), 0, 0.1);
    EXPECT_NEAR(beams::rad_to_deg(found->mount.pitch_rad), pitch_deg, 0.15);
  }
}

TEST(MountEstimate, GivesTheSameMountEachTime) {
  Scene scene(Mount{});
  scene.add_street(0.05);
  const auto first = estimate_mount(scene.points());
  const auto second = estimate_mount(scene.points());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->mount.height_m, second->mount.height_m);
  EXPECT_EQ(first->mount.roll_rad, second->mount.roll_rad);
  EXPECT_EQ(first->mount.pitch_rad, second->mount.pitch_rad);
}

TEST(MountEstimate, LeavesOutPointsThatAreNotFinite) {
  Scene scene(Mount{});
  scene.add_street(0.02);
  Cloud points = scene.points();
  for (std::size_t i = 0; i < points.size(); i += 10) {
    points[i][i % 3] = i % 20 == 0 ? NAN : INFINITY;
  }
  const auto found = estimate_mount(points);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_NEAR(found->mount.height_m, 1.73, 0.03);
}

TEST(MountEstimate, SaysWhenThereAreTooFewPoints) {
  EXPECT_THAT(
      estimate_mount({}),
      calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("0 points are seen, 150 are needed")));
}

TEST(MountEstimate, SaysWhenThereIsNoGround) {
  Scene walls(Mount{});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-20, 20), up(0.0, 30.0);
  for (int i = 0; i < 20000; ++i) walls.add(at(random), 1.4, up(random));
  EXPECT_THAT(estimate_mount(walls.points()),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("no ground plane")));
  Scene line(Mount{});
  for (int i = 0; i < 2000; ++i) line.add(4 + 0.01 * i, 0, 0);
  EXPECT_FALSE(estimate_mount(line.points()).has_value());
}

TEST(MountEstimate, DoesNotStandUpsideDown) {
  const auto folder = test::shared_data("semantickitti_more/sequences");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".bin") continue;
    Cloud points = strip_of_scan(entry.path());
    for (auto& p : points) p = {p[0], -p[1], -p[2]};
    EXPECT_FALSE(estimate_mount(points)) << entry.path();
  }
}

TEST(MountEstimate, FindsKittisSensorAboutItsPublishedHeight) {
  const auto folder = test::shared_data("semantickitti/sequences");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  int scans = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".bin") continue;
    const auto found = estimate_mount(strip_of_scan(entry.path()));
    ASSERT_TRUE(found.has_value()) << entry.path() << found.error().message;
    EXPECT_NEAR(found->mount.height_m, 1.73, 0.1) << entry.path();
    EXPECT_LT(std::abs(beams::rad_to_deg(found->mount.roll_rad)), 4.0) << entry.path();
    EXPECT_LT(std::abs(beams::rad_to_deg(found->mount.pitch_rad)), 3.0) << entry.path();
    ++scans;
  }
  EXPECT_GT(scans, 0);
}

}  // namespace
}  // namespace terracut::mount
