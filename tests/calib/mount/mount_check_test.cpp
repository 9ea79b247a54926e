// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_check.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/calib/mount/sensor_view.hpp"

namespace terracut::mount {
namespace {

using test::mount_in_degrees;
using Cloud = std::vector<std::array<float, 3>>;

/// What a sensor on `truth` sees, in the vehicle frame that `given` leads to: the inverse of the
/// one mount, then the other.
class Seen {
 public:
  Seen(const Mount& truth, const Mount& given)
      : T_true_(T_vehicle_lidar(truth)), T_given_(T_vehicle_lidar(given)) {}

  void add(double x, double y, double z) {
    const double d[3] = {x - T_true_[3], y - T_true_[7], z - T_true_[11]};
    double s[3];
    for (std::size_t i = 0; i < 3; ++i) {
      s[i] = T_true_[i] * d[0] + T_true_[4 + i] * d[1] + T_true_[8 + i] * d[2];
    }
    const auto p = apply(T_given_, s[0], s[1], s[2]);
    points_.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  /// The lane before and behind, from `from_m` on, at height z = rise * distance.
  Seen& add_lane(double from_m = 3, double to_m = 20, double rise = 0) {
    for (double x = from_m; x < to_m; x += 0.25) {
      for (double y = -1.5; y <= 1.5; y += 0.25) {
        add(x, y, rise * x);
        add(-x, y, rise * x);
      }
    }
    return *this;
  }
  /// Points of one height in the lane ahead.
  Seen& add_deck(double from_m, double to_m, double height_m, double step_m) {
    for (double x = from_m; x < to_m; x += step_m) {
      for (double y = -1.2; y <= 1.2; y += step_m) add(x, y, height_m);
    }
    return *this;
  }
  [[nodiscard]] const Cloud& points() const { return points_; }

 private:
  RigidTransform T_true_, T_given_;
  Cloud points_;
};

std::optional<Mount> verdict(const Mount& given, const Cloud& each_frame, int frames = 3) {
  MountCheck check(given);
  for (int i = 0; i < frames; ++i) check.add_frame(each_frame);
  return check.contradiction();
}

TEST(MountCheck, AgreesWithTheMountThatIsTheRightOne) {
  for (const Mount& truth : {mount_in_degrees(0.5, 0, 0), mount_in_degrees(1.73, 0, 0),
                             mount_in_degrees(3, -4, 12), mount_in_degrees(5.5, 0, 0)}) {
    EXPECT_FALSE(verdict(truth, Seen(truth, truth).add_lane().points(), 20)) << truth.height_m;
  }
}

TEST(MountCheck, ShowsTheMountThatTheGroundIsSeenFrom) {
  struct Case {
    Mount truth, given;
  };
  for (const auto& [truth, given] :
       {Case{mount_in_degrees(0.5, 0, 0), mount_in_degrees(1.73, 0, 0)},
        Case{mount_in_degrees(1.2, 0, 0), mount_in_degrees(1.73, 0, 0)},
        Case{mount_in_degrees(2.5, 0, 0), mount_in_degrees(1.73, 0, 0)},
        Case{mount_in_degrees(1.73, 0, 10), mount_in_degrees(1.73, 0, 0)},
        Case{mount_in_degrees(1.73, 0, 0), mount_in_degrees(1.73, 0, 10)},
        Case{mount_in_degrees(1.73, -6, 0), mount_in_degrees(1.73, 0, 0)},
        Case{mount_in_degrees(1.73, 0, 0), mount_in_degrees(2.03, 0, 0)},
        Case{mount_in_degrees(1.73, 0, 0), mount_in_degrees(1.43, 0, 0)},
        Case{mount_in_degrees(1.73, 0, 0), mount_in_degrees(1.73, 4, 0)},
        Case{mount_in_degrees(1.73, 0, 0), mount_in_degrees(1.73, 0, -3)},
        Case{mount_in_degrees(0.8, 3, -8), mount_in_degrees(1.73, 2, 3)}}) {
    const auto seen = verdict(given, Seen(truth, given).add_lane().points());
    ASSERT_TRUE(seen) << truth.height_m << " " << given.height_m;
    EXPECT_NEAR(seen->height_m, truth.height_m, 0.01);
    EXPECT_NEAR(beams::rad_to_deg(seen->roll_rad), beams::rad_to_deg(truth.roll_rad), 0.1);
    EXPECT_NEAR(beams::rad_to_deg(seen->pitch_rad), beams::rad_to_deg(truth.pitch_rad), 0.1);
  }
}

TEST(MountCheck, KnowsTheMountBetterFromADriveAndLeavesOutWhatContradicts) {
  const Mount given = mount_in_degrees(1.73, 0, 0), truth = mount_in_degrees(1.76, 0.5, -0.3);
  MountCheck check(given);
  EXPECT_FALSE(check.by_drive());
  const Cloud seen = Seen(truth, given).add_lane().points();
  const Cloud elsewhere = Seen(mount_in_degrees(1.2, 0, 0), given).add_lane().points();
  for (int i = 0; i < 12; ++i) check.add_frame(i % 4 == 0 ? elsewhere : seen);
  EXPECT_FALSE(check.contradiction());
  const auto by_drive = check.by_drive();
  ASSERT_TRUE(by_drive);
  EXPECT_NEAR(by_drive->height_m, truth.height_m, 0.005);
  EXPECT_NEAR(beams::rad_to_deg(by_drive->roll_rad), 0.5, 0.1);
  EXPECT_NEAR(beams::rad_to_deg(by_drive->pitch_rad), -0.3, 0.1);
}

TEST(MountCheck, SaysNothingOfWhatItsTolerancesAllow) {
  const Mount given = mount_in_degrees(1.73, 0, 0);
  for (const Mount& truth : {mount_in_degrees(1.9, 0, 0), mount_in_degrees(1.56, 0, 0),
                             mount_in_degrees(1.73, 3.2, -2.2)}) {
    EXPECT_FALSE(verdict(given, Seen(truth, given).add_lane().points()));
  }
}

TEST(MountCheck, NeedsSeveralFramesThatAgree) {
  const Mount given = mount_in_degrees(1.73, 0, 0), truth = mount_in_degrees(1.2, 0, 0);
  const Cloud wrong = Seen(truth, given).add_lane().points();
  const Cloud right = Seen(given, given).add_lane().points();
  EXPECT_FALSE(verdict(given, wrong, 2));
  MountCheck check(given);
  for (int i = 0; i < 10; ++i) check.add_frame(i % 2 == 0 ? wrong : right);
  EXPECT_FALSE(check.contradiction()) << "half of the frames only";
  for (int i = 0; i < 10; ++i) check.add_frame(wrong);
  EXPECT_TRUE(check.contradiction()) << "the newest frames count";
  for (int i = 0; i < 10; ++i) check.add_frame(right);
  EXPECT_FALSE(check.contradiction()) << "what was put right is no longer said";
  EXPECT_EQ(check.frames(), 30U);
}

TEST(MountCheck, IsNotMisledByALongRoofUnderTheSensor) {
  const Mount given =
      mount_in_degrees(3.2, 0, 0);  // on a bus, whose roof begins 0.5 m below and is 9 m long
  const auto scene =
      Seen(given, given).add_lane(9).add_deck(3, 9, 2.7, 0.1);  // more points than the road
  EXPECT_FALSE(verdict(given, scene.points()));
}

TEST(MountCheck, IsNotMisledByALorryAheadAndSlopesBeyond) {
  const Mount given = mount_in_degrees(1.73, 0, 0);
  EXPECT_FALSE(
      verdict(given, Seen(given, given).add_lane(3, 8).add_deck(6, 14, 1.2, 0.08).points()));
  // Level where it stands, and up or down from 6 m on, on both sides: a hollow, and a crest.
  for (const double rise : {0.12, -0.12}) {
    Seen scene(given, given);
    scene.add_lane(3, 6);
    for (double x = 6; x < 25; x += 0.25) {
      for (double y = -1.5; y <= 1.5; y += 0.25) {
        scene.add(x, y, rise * (x - 6));
        scene.add(-x, y, rise * (x - 6));
      }
    }
    EXPECT_FALSE(verdict(given, scene.points())) << rise;
  }
}

TEST(MountCheck, AFrameWithoutGroundCountsForNothing) {
  MountCheck check(mount_in_degrees(1.73, 0, 0));
  for (int i = 0; i < 20; ++i) check.add_frame({});
  EXPECT_EQ(check.frames(), 0U);
  EXPECT_FALSE(check.contradiction());
}

}  // namespace
}  // namespace terracut::mount
