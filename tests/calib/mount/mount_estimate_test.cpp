// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_estimate.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "calib/beams/angle.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::mount {
namespace {

using testing::HasSubstr;
using Cloud = std::vector<std::array<float, 3>>;

/// Puts points of the vehicle frame into the frame of a sensor on `mount`.
class Scene {
 public:
  explicit Scene(const Mount& mount) : T_(T_vehicle_lidar(mount)) {}

  void add(double x, double y, double z) {
    const double d[3] = {x - T_[3], y - T_[7], z - T_[11]};
    std::array<float, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {  // transposed rotation
      p[i] = static_cast<float>(T_[i] * d[0] + T_[4 + i] * d[1] + T_[8 + i] * d[2]);
    }
    points_.push_back(p);
  }

  /// Ground out to 40 m, as dense as rings make it, with a sidewalk, walls and cars.
  void add_street(double noise_m) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, noise_m);
    std::uniform_real_distribution<double> frame(0.0, 6.2831853), share(0.0, 1.0);
    for (int i = 0; i < 30000; ++i) {
      const double range = 2.5 + 37.5 * share(random) * share(random), at = frame(random);
      const double y = range * std::sin(at);
      add(range * std::cos(at), y, (y > 6 ? 0.15 : 0.0) + noise(random));
    }
    for (int i = 0; i < 15000; ++i) {  // walls left and right
      add(-20 + 40 * share(random), i % 2 == 0 ? 10.0 : -8.0, 6 * share(random));
    }
    for (int i = 0; i < 6000; ++i) {  // roofs, bonnets and sides of parked cars
      add(4 + 16 * share(random), -4.5 + 1.8 * share(random), i % 3 == 0 ? 1.45 : share(random));
    }
  }

  const Cloud& points() const { return points_; }

 private:
  RigidTransform T_;
  Cloud points_;
};

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
        EXPECT_GT(found->inlier_share, 0.3);
        EXPECT_LT(found->rms_m, 0.05);
      }
    }
  }
}

TEST(MountEstimate, IsExactOnAPerfectPlane) {
  const Mount mount{2.0, beams::deg_to_rad(1.5), beams::deg_to_rad(-2.5)};
  Scene scene(mount);
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) scene.add(x, y, 0);
  }
  const auto found = estimate_mount(scene.points());
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_NEAR(found->mount.height_m, 2.0, 1e-5);
  EXPECT_NEAR(found->mount.roll_rad, mount.roll_rad, 1e-6);
  EXPECT_NEAR(found->mount.pitch_rad, mount.pitch_rad, 1e-6);
  EXPECT_NEAR(found->inlier_share, 1.0, 1e-9);
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
  EXPECT_THAT(estimate_mount({}),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("found 0")));
}

TEST(MountEstimate, SaysWhenThereIsNoGround) {
  Scene walls(Mount{});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-20, 20), up(0.0, 30.0);
  for (int i = 0; i < 20000; ++i) walls.add(at(random), 8.0, up(random));
  EXPECT_THAT(estimate_mount(walls.points()),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("no ground plane")));
  Scene line(Mount{});
  for (int i = 0; i < 2000; ++i) line.add(4 + 0.01 * i, 0, 0);
  EXPECT_FALSE(estimate_mount(line.points()).has_value());
}

TEST(MountEstimate, FindsKittisSensorAboutItsPublishedHeight) {
  const auto folder = test::shared_data("semantickitti/sequences");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  int scans = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".bin") continue;
    const std::string bytes = calib::read_text(entry.path());
    Cloud points(bytes.size() / 16);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::copy_n(bytes.data() + 16 * i, 12, reinterpret_cast<char*>(points[i].data()));
    }
    const auto found = estimate_mount(points);
    ASSERT_TRUE(found.has_value()) << entry.path() << found.error().message;
    RecordProperty(entry.path().filename().string(), std::to_string(found->mount.height_m));
    EXPECT_NEAR(found->mount.height_m, 1.73, 0.1) << entry.path();
    EXPECT_LT(std::abs(beams::rad_to_deg(found->mount.roll_rad)), 4.0) << entry.path();
    EXPECT_LT(std::abs(beams::rad_to_deg(found->mount.pitch_rad)), 3.0) << entry.path();
    ++scans;
  }
  EXPECT_GT(scans, 0);
}

}  // namespace
}  // namespace terracut::mount
