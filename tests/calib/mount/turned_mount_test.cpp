// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/turned_mount.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "calib/beams/angle.hpp"
#include "tests/calib/calib_test_support.hpp"
#include "tests/calib/mount/sensor_view.hpp"

namespace terracut::mount {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Cloud = std::vector<std::array<float, 3>>;

Mount on_mount(double height_m, double roll_deg, double pitch_deg) {
  return {height_m, beams::deg_to_rad(roll_deg), beams::deg_to_rad(pitch_deg)};
}

/// A street of 30 m either way, with houses and trees of all heights beside it.
Cloud street(const Mount& mount) {
  test::SensorView view(mount);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double range_m = 1 + 29 * share(random) * share(random);
    view.add(i % 2 == 0 ? range_m : -range_m, 8 * share(random) - 4, 0.01 * share(random));
  }
  for (int i = 0; i < 3000; ++i) {
    view.add(60 * share(random) - 30, i % 2 == 0 ? 6 : -6, 12 * share(random));
  }
  return view.points();
}

/// Those before and behind the sensor, as pipeline/ground takes them.
Cloud strip_of(const Cloud& around) {
  Cloud strip;
  for (const auto& p : around) {
    const float range_m = std::hypot(p[0], p[1]);
    if (std::abs(p[1]) <= 1.5F && range_m >= 3 && range_m <= 15) strip.push_back(p);
  }
  return strip;
}

Expected<MountEstimate> estimate(const Cloud& around) {
  return estimate_turned_mount(strip_of(around), around);
}

/// A level from (-length, -width) to (length, width), as dense as a sensor sees it near by.
void add_level(test::SensorView& view, double length_m, double width_m, double z_m) {
  for (double x = -length_m; x < length_m; x += 0.2) {
    for (double y = -width_m; y < width_m; y += 0.2) view.add(x, y, z_m);
  }
}

TEST(TurnedMount, IsThatOfASensorUpsideDownOrTilted) {
  for (const Mount& truth :
       {on_mount(1.73, 180, 0), on_mount(1.6, -176, 4), on_mount(2.4, 160, -12),
        on_mount(1.73, 45, 0), on_mount(1.73, -30, 20), on_mount(3, 0, 50), on_mount(1.73, 0, -35),
        on_mount(1.2, 130, 10)}) {
    const auto seen = estimate(street(truth));
    ASSERT_TRUE(seen) << truth.roll_rad << " " << truth.pitch_rad << ": " << seen.error().message;
    EXPECT_NEAR(seen->mount.height_m, truth.height_m, 0.02);
    EXPECT_NEAR(std::remainder(seen->mount.roll_rad - truth.roll_rad, 2 * std::numbers::pi), 0,
                beams::deg_to_rad(0.3));
    EXPECT_NEAR(seen->mount.pitch_rad, truth.pitch_rad, beams::deg_to_rad(0.3));
  }
}

TEST(TurnedMount, IsNotBelievedUnderACeilingWithTheFloorFarBelow) {
  // High up on a lorry in a hall: the floor is not seen before 20 m.
  test::SensorView view(on_mount(4, 0, 0));
  add_level(view, 15, 6, 5.5);
  for (double x = 20; x < 50; x += 0.3) {
    for (double y = -6; y < 6; y += 0.3) view.add(x, y, 0);
  }
  EXPECT_THAT(
      estimate(view.points()),
      calib::IsRefusedWith(
          ErrorCode::kMalformed,
          AllOf(HasSubstr("a plane 1.50 m above"), HasSubstr("a level on the sensor's other side"),
                HasSubstr("is it upside down (--mount-roll 180 --mount-pitch"))));
}

TEST(TurnedMount, IsNotBelievedWhereThingsLieBeyondTheGround) {
  test::SensorView view(on_mount(1.5, 0, 0));  // a canopy with girders, and what stands on it
  add_level(view, 15, 3, 4);
  add_level(view, 15, 1, 4.6);
  EXPECT_THAT(estimate(view.points()),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("is it upside down")));
}

TEST(TurnedMount, IsNotThatOfAWallBesideTheSensor) {
  test::SensorView view(on_mount(1.73, 0, 0));
  for (double x = -15; x < 15; x += 0.2) {
    for (double z = 0.5; z < 5; z += 0.2) view.add(x, 1.4, z);
  }
  EXPECT_THAT(estimate(view.points()),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("beside it"), HasSubstr("--mount-roll 90"))));
}

TEST(TurnedMount, IsNoneWithoutPoints) {
  EXPECT_THAT(estimate({}), calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("nor is one")));
}

}  // namespace
}  // namespace terracut::mount
