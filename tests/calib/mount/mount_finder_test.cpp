// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_finder.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "calib/beams/angle.hpp"
#include "tests/calib/calib_test_support.hpp"
#include "tests/calib/mount/sensor_view.hpp"

namespace terracut::mount {
namespace {

using test::mount_in_degrees;
using test::SensorView;
using testing::HasSubstr;

/// The lane before and behind, up to 15 m, its heights by `z_m`.
template <class Height>
SensorView lane(const Mount& mount, double from_m, const Height& z_m) {
  SensorView view(mount);
  for (double x = from_m; x < 15; x += 0.2) {
    for (double y = -1.4; y < 1.5; y += 0.2) {
      view.add(x, y, z_m(x, y));
      view.add(-x, y, z_m(-x, y));
    }
  }
  return view;
}

double level(double, double) {
  return 0;
}

/// Waves of a few metres, as worn asphalt has them.
class UnevenGround {
 public:
  UnevenGround(unsigned seed, double waves_m) : waves_m_(waves_m) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi), length_m(3, 8);
    for (Wave& wave : wave_) wave = {turn(random), turn(random), length_m(random)};
  }
  double operator()(double x, double y) const {
    double z_m = 0;
    for (const Wave& w : wave_) {
      const double along_m = x * std::cos(w.heading_rad) + y * std::sin(w.heading_rad);
      z_m += std::sin(2 * std::numbers::pi * along_m / w.length_m + w.phase_rad);
    }
    return waves_m_ * z_m / std::sqrt(kWaves / 2.0);
  }

 private:
  static constexpr int kWaves = 6;
  struct Wave {
    double phase_rad, heading_rad, length_m;
  };
  double waves_m_;
  std::array<Wave, kWaves> wave_;
};

TEST(MountFinder, FindsTheMountThatASensorStandsOn) {
  for (const Mount& truth :
       {mount_in_degrees(0.8, 5, -5), mount_in_degrees(1.73, 0, 0), mount_in_degrees(3, -4, 5)}) {
    MountFinder finder;
    EXPECT_TRUE(finder.add_frame(lane(truth, 3, level).points()));
    const auto found = finder.found();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->mount.height_m, truth.height_m, 0.001);
    EXPECT_NEAR(found->mount.roll_rad, truth.roll_rad, beams::deg_to_rad(0.01));
    EXPECT_NEAR(found->mount.pitch_rad, truth.pitch_rad, beams::deg_to_rad(0.01));
    EXPECT_EQ(found->frames, 1U);
    EXPECT_TRUE(found->is_certain());
  }
}

TEST(MountFinder, IsNotMisledByFramesInWhichTheRoadIsHidden) {
  const Mount truth = mount_in_degrees(1.73, 1, 2);
  const auto roof = [](double, double) { return 1.2; };  // long, and all that is seen
  MountFinder finder;
  for (int i = 0; i < 10; ++i) {
    finder.add_frame((i % 3 == 1 ? lane(truth, 3, roof) : lane(truth, 3, level)).points());
  }
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(finder.add_frame({}));
  const auto found = finder.found();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->mount.height_m, 1.73, 0.001);
  EXPECT_EQ(finder.frames(), 10U);
  EXPECT_EQ(finder.frames_looked_at(), 15U);
}

TEST(MountFinder, StandsByItsUncertaintyOnUnevenGround) {
  constexpr int kRoads = 60;
  const Mount truth = mount_in_degrees(1.73, 0, 0);
  int height_held = 0, roll_held = 0, pitch_held = 0;
  for (unsigned seed = 0; seed < kRoads; ++seed) {
    const UnevenGround ground(seed, 0.02);
    MountFinder finder;
    finder.add_frame(lane(truth, 4, ground).points());
    const auto found = finder.found();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_LT(found->uncertainty.height_m, 0.04);
    EXPECT_LT(found->uncertainty.pitch_rad, beams::deg_to_rad(0.5));
    const auto holds = [&](double Mount::* figure) {
      return std::abs(found->mount.*figure - truth.*figure) <= found->uncertainty.*figure ? 1 : 0;
    };
    height_held += holds(&Mount::height_m);
    roll_held += holds(&Mount::roll_rad);
    pitch_held += holds(&Mount::pitch_rad);
  }
  EXPECT_GE(height_held, kRoads * 9 / 10);
  EXPECT_GE(roll_held, kRoads * 9 / 10);
  EXPECT_GE(pitch_held, kRoads * 9 / 10);
}

TEST(MountFinder, IsLessCertainTheLessGroundItSees) {
  const Mount truth = mount_in_degrees(3, 0, 0);
  const auto uncertainty = [&](double from_m) {
    MountFinder finder;
    finder.add_frame(lane(truth, from_m, level).points());
    return finder.found().value();
  };
  const FoundMount wide = uncertainty(3), narrow = uncertainty(11), one_ring = uncertainty(13.8);
  EXPECT_LT(wide.uncertainty.height_m, narrow.uncertainty.height_m);
  EXPECT_LT(narrow.uncertainty.height_m, one_ring.uncertainty.height_m);
  EXPECT_TRUE(wide.is_certain());
  EXPECT_FALSE(one_ring.is_certain()) << "the road between may be a hollow";
  EXPECT_NEAR(one_ring.mount.height_m, 3, 0.01);
  MountFinder finder;
  finder.add_frame(lane(truth, 13.8, level).points());
  EXPECT_THAT(finder.certain(), calib::IsRefusedWith(ErrorCode::kMountNotFound,
                                                     HasSubstr("it is uncertain: height 3.0")));
}

TEST(MountFinder, IsLessCertainTheMoreFramesDiffer) {
  MountFinder alike, different;
  for (int i = 0; i < 10; ++i) {
    alike.add_frame(lane(mount_in_degrees(1.73, 0, 0), 3, level).points());
    different.add_frame(lane(mount_in_degrees(1.73 + 0.01 * i, 0, 0), 3, level).points());
  }
  const auto sure = alike.found(), unsure = different.found();
  ASSERT_TRUE(sure && unsure);
  EXPECT_LT(sure->uncertainty.height_m, 0.03);
  EXPECT_GT(unsure->uncertainty.height_m, 0.05);
  EXPECT_NEAR(unsure->mount.height_m, 1.775, 0.001) << "between the middle ones";
}

TEST(MountFinder, AnswersAMountThatCanBeStatedAsItIsPrinted) {
  MountFinder finder;
  finder.add_frame(lane(mount_in_degrees(1.73456789, 1.23456, -2.34567), 3, level).points());
  const auto found = finder.found();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->mount.height_m, 1.735);
  EXPECT_EQ(found->mount.roll_rad, beams::deg_to_rad(1.23));
  EXPECT_EQ(found->mount.pitch_rad, beams::deg_to_rad(-2.35));
}

TEST(MountFinder, TakesTheRollOfASensorUpsideDownAcrossTheHalfTurn) {
  MountFinder finder;
  for (const double roll_deg : {179.0, -179.8, 179.6, -179.6, -178.0}) {
    finder.add_estimate(
        MountEstimate{mount_in_degrees(1.73, roll_deg, 1), mount_in_degrees(0.01, 0.1, 0.1), 0});
  }
  const auto found = finder.certain();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->mount.roll_rad, beams::deg_to_rad(-179.8));
}

TEST(MountFinder, SaysWhyThereIsNoMount) {
  MountFinder finder;
  EXPECT_THAT(finder.found(),
              calib::IsRefusedWith(ErrorCode::kMountNotFound, HasSubstr("no frame")));
  const auto seen = lane(mount_in_degrees(1.73, 0, 0), 3, level);
  finder.add_frame(seen.points());
  finder.add_frame({});
  EXPECT_TRUE(finder.found()) << "half of the frames are enough";
  finder.add_frame({});
  EXPECT_THAT(finder.found(), calib::IsRefusedWith(ErrorCode::kMountNotFound,
                                                   HasSubstr("of 3 frames 1 show a ground; of the "
                                                             "ground 3 to 15 m")));
}

}  // namespace
}  // namespace terracut::mount
