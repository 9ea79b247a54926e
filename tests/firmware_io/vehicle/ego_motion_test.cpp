// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/ego_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/support/allocation_counter.hpp"

namespace terracut::vehicle {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

std::int64_t at_ms(double ms) {
  return kStart_ns + static_cast<std::int64_t>(ms * 1e6);
}

class EgoMotionTest : public testing::Test {
 protected:
  /// Samples every 10 ms.
  void drive(double from_ms, double to_ms, double speed_mps, double yaw_rate_radps) {
    for (double ms = from_ms; ms <= to_ms; ms += 10) {
      EXPECT_TRUE(motion_.add({at_ms(ms), speed_mps, yaw_rate_radps}));
    }
    motion_.take_new();
  }
  /// The pose at one instant seen from another; nothing where there is no ego motion.
  static std::optional<PlanarPose> pose(const EgoMotion& motion, double instant_ms,
                                        double reference_ms) {
    const std::array<std::int64_t, 1> instant_ns{at_ms(instant_ms)};
    std::array<PlanarPose, 1> pose;
    if (!motion.poses(instant_ns, at_ms(reference_ms), pose)) return std::nullopt;
    return pose[0];
  }
  [[nodiscard]] std::optional<PlanarPose> pose(double instant_ms, double reference_ms) const {
    return pose(motion_, instant_ms, reference_ms);
  }

  memory::FixedMemory memory_;
  EgoMotion motion_{{}, memory_};
};

TEST_F(EgoMotionTest, ASteadyTurnIsAnArcSeenFromAnyReference) {
  drive(0, 200, 20, 0.5);
  for (const double reference_ms : {37.0, 80.0, 150.0, 200.0}) {
    for (const double instant_ms : {11.0, 80.0, 123.4, 199.0}) {
      const auto found = pose(instant_ms, reference_ms);
      ASSERT_TRUE(found);
      const double rotated_rad = 0.5 * (instant_ms - reference_ms) * 1e-3;
      EXPECT_NEAR(found->x_m, 40 * std::sin(rotated_rad), 1e-6);
      EXPECT_NEAR(found->y_m, 40 * (1 - std::cos(rotated_rad)), 1e-6);
      EXPECT_NEAR(found->sine, std::sin(rotated_rad), 1e-9);
    }
  }
}

TEST_F(EgoMotionTest, ChangingSpeedAddsUpAlongTheWay) {
  // 10 m/s rising by 5 m/s a second: way = 10 t + 2.5 t^2.
  for (int i = 0; i <= 20; ++i) motion_.add({at_ms(10 * i), 10 + 0.05 * i, 0});
  motion_.take_new();
  const auto found = pose(200, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x_m, 10 * 0.2 + 2.5 * 0.04, 1e-9);
}

TEST_F(EgoMotionTest, PosesOfManyInstantsAreThoseOfEach) {
  for (int i = 0; i <= 30; ++i) motion_.add({at_ms(10 * i), 15.0 + i, 0.4 - 0.02 * i});
  motion_.take_new();
  std::vector<std::int64_t> instants_ns;
  for (double ms = 5; ms < 300; ms += 3.7) instants_ns.push_back(at_ms(ms));
  std::vector<PlanarPose> poses(instants_ns.size());
  ASSERT_TRUE(motion_.poses(instants_ns, at_ms(250), poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::array<PlanarPose, 1> alone;
    ASSERT_TRUE(motion_.poses(std::span(instants_ns).subspan(i, 1), at_ms(250), alone));
    EXPECT_NEAR(poses[i].x_m, alone[0].x_m, 1e-9);
    EXPECT_NEAR(poses[i].y_m, alone[0].y_m, 1e-9);
    EXPECT_NEAR(poses[i].sine, alone[0].sine, 1e-12);
  }
}

TEST_F(EgoMotionTest, TheSensorSwingsAboutTheRearAxle) {
  EgoMotion ahead({.sensor_ahead_m = 1.5, .sensor_left_m = 0.2}, memory_);
  for (int i = 0; i <= 10; ++i) ahead.add({at_ms(10 * i), 0, 0.5});
  ahead.take_new();
  const auto found = pose(ahead, 100, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x_m, 1.5 * std::cos(0.05) - 0.2 * std::sin(0.05) - 1.5, 1e-9);
  EXPECT_NEAR(found->y_m, 1.5 * std::sin(0.05) + 0.2 * std::cos(0.05) - 0.2, 1e-9);
}

TEST_F(EgoMotionTest, TheNewestSampleHoldsForTheMaximumAgeAndNoLonger) {
  EXPECT_FALSE(pose(0, 0));
  drive(0, 100, 20, 0);
  EXPECT_NEAR(pose(200, 0).value().x_m, 4, 1e-9);
  EXPECT_FALSE(pose(200.1, 0));
  EXPECT_FALSE(pose(0, 200.1));
  EXPECT_NEAR(pose(-100, 0).value().x_m, -2, 1e-9);
  EXPECT_FALSE(pose(-100.1, 0));
}

TEST_F(EgoMotionTest, AGapLongerThanTheMaximumAgeIsNotBridged) {
  drive(0, 100, 20, 0);
  drive(210, 400, 20, 0);
  EXPECT_FALSE(pose(90, 220));
  EXPECT_FALSE(pose(220, 90));
  EXPECT_FALSE(pose(150, 160));
  EXPECT_TRUE(pose(10, 90));
  EXPECT_TRUE(pose(220, 400));
}

TEST_F(EgoMotionTest, OfALongDriveTheNewestSamplesAreKept) {
  EgoMotion brief({.kept = 16}, memory_);
  for (int i = 0; i < 100; ++i) {
    brief.add({at_ms(10 * i), 20, 0});
    brief.take_new();
  }
  EXPECT_NEAR(pose(brief, 990, 850).value().x_m, 2.8, 1e-9);
  EXPECT_FALSE(pose(brief, 990, 700));
}

TEST_F(EgoMotionTest, SamplesThatNobodyShouldUseAreCountedByTheirCause) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  drive(0, 50, 20, 0);
  EXPECT_FALSE(motion_.add({at_ms(60), kNothing, 0}));
  EXPECT_FALSE(motion_.add({at_ms(60), 20, kNothing}));
  EXPECT_FALSE(motion_.add({at_ms(60), 20, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(motion_.add({at_ms(60), 151, 0}));
  EXPECT_FALSE(motion_.add({at_ms(60), -151, 0}));
  EXPECT_FALSE(motion_.add({at_ms(60), 20, 11}));
  EXPECT_FALSE(motion_.add({at_ms(60), 20, -11}));
  EXPECT_FALSE(motion_.add({at_ms(50), 20, 0}));
  EXPECT_FALSE(motion_.add({at_ms(30), 20, 0}));
  const EgoMotionCounters counters = motion_.counters();
  EXPECT_EQ(counters.accepted, 6U);
  EXPECT_EQ(counters.implausible, 7U);
  EXPECT_EQ(counters.out_of_order, 2U);
  EXPECT_EQ(counters.not_taken, 0U);
}

TEST_F(EgoMotionTest, ASampleFromBeforeTheNewestIsANewBeginningIfItIsNoDisorder) {
  drive(0, 200, 20, 0);
  EXPECT_TRUE(motion_.add({at_ms(179), 10, 0}));
  motion_.take_new();
  EXPECT_EQ(motion_.newest_ns(), at_ms(179));
  EXPECT_NEAR(pose(189, 179).value().x_m, 0.1, 1e-9) << "nothing of the time before is left";
  EXPECT_FALSE(pose(179, 70));
  EXPECT_EQ(motion_.counters().out_of_order, 0U);
}

TEST_F(EgoMotionTest, SamplesOfATimeThatIsOverAreForgottenThoseOnTheirWayToo) {
  drive(0, 100, 20, 0);
  EXPECT_TRUE(motion_.add({at_ms(110), 20, 0}));
  motion_.reset();
  EXPECT_FALSE(motion_.newest_ns());
  EXPECT_FALSE(pose(100, 90));
  drive(120, 150, 10, 0);
  EXPECT_NEAR(pose(150, 90).value().x_m, 0.6, 1e-9);
}

TEST_F(EgoMotionTest, AMotionThatWasLostIsKnownAgainFromAMaximumAgeBeforeItsFirstSample) {
  drive(0, 100, 20, 0);
  drive(1000, 1200, 10, 0);
  EXPECT_NEAR(pose(1200, 900).value().x_m, 3, 1e-9);
  EXPECT_FALSE(pose(1200, 899.9));
  EXPECT_FALSE(pose(600, 600));
}

TEST_F(EgoMotionTest, ALogThatStartsOverIsANewBeginning) {
  drive(5000, 5200, 20, 0);
  drive(0, 100, 10, 0);
  EXPECT_NEAR(pose(100, 0).value().x_m, 1, 1e-9);
  EXPECT_FALSE(pose(5100, 5000));
  EXPECT_EQ(motion_.newest_ns(), at_ms(100));
}

TEST_F(EgoMotionTest, WhatAReaderThatWasAwayMissesIsCountedAndOldValuesAreNotUsed) {
  EgoMotion motion({.waiting = 8}, memory_);
  for (int i = 0; i < 20; ++i) motion.add({at_ms(10 * i), 20, 0});
  EXPECT_EQ(motion.counters().accepted, 8U);
  EXPECT_EQ(motion.counters().not_taken, 12U);
  motion.take_new();
  EXPECT_FALSE(pose(motion, 190, 180));
  motion.add({at_ms(190), 20, 0});
  motion.take_new();
  EXPECT_TRUE(pose(motion, 195, 190));
}

TEST_F(EgoMotionTest, SettingsOutsideTheirRangeAreRefused) {
  EXPECT_THROW(EgoMotion({.max_age_ns = 0}, memory_), std::invalid_argument);
  EXPECT_THROW(EgoMotion({.max_age_ns = 1'000'000'001}, memory_), std::invalid_argument);
  EXPECT_THROW(EgoMotion({.sensor_ahead_m = -100.5}, memory_), std::invalid_argument);
  EXPECT_THROW(EgoMotion({.sensor_left_m = 100.5}, memory_), std::invalid_argument);
  EXPECT_NO_THROW(EgoMotion({.sensor_ahead_m = 100, .sensor_left_m = -100}, memory_));
  EXPECT_THROW(EgoMotion({.waiting = 0}, memory_), std::invalid_argument);
  EXPECT_THROW(EgoMotion({.kept = 1}, memory_), std::invalid_argument);
}

TEST_F(EgoMotionTest, GivingAndAskingAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  const std::uint64_t before = test::allocations_of_this_thread();
  drive(0, 2000, 20, 0.1);
  EXPECT_TRUE(pose(1990, 1900));
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

/// The speed of a sample says what its stamp must be, so that a torn or foreign one shows.
double speed_at(std::int64_t stamp_ns) {
  return static_cast<double>((stamp_ns - kStart_ns) / kMillisecond_ns % 100);
}

TEST_F(EgoMotionTest, SamplesOfAnotherThreadArriveWholeAndInOrder) {
  EgoMotion motion({.waiting = 256, .kept = 512}, memory_);
  constexpr int kSamples = 20'000;
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < kSamples; ++i) {
      const std::int64_t stamp_ns = kStart_ns + i * kMillisecond_ns;
      while (!motion.add({stamp_ns, speed_at(stamp_ns), 0})) std::this_thread::yield();
    }
    done.store(true);
  });
  std::uint64_t wrong = 0, answers = 0;
  std::int64_t last_ns = 0;
  for (bool last_round = false; !last_round;) {
    last_round = done.load();
    motion.take_new();
    const auto newest_ns = motion.newest_ns();
    if (!newest_ns) continue;
    wrong += *newest_ns < last_ns ? 1 : 0;
    last_ns = *newest_ns;
    if (*newest_ns < kStart_ns + kMillisecond_ns) continue;
    // Between the last two samples lies the mean of their speeds, for a millisecond.
    const std::array<std::int64_t, 1> instant_ns{*newest_ns};
    std::array<PlanarPose, 1> pose;
    const bool found = motion.poses(instant_ns, *newest_ns - kMillisecond_ns, pose);
    const double mean_mps = (speed_at(*newest_ns) + speed_at(*newest_ns - kMillisecond_ns)) / 2;
    wrong += found && std::abs(pose[0].x_m - mean_mps * 1e-3) < 1e-9 ? 0 : 1;
    ++answers;
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(answers, 0U);
  EXPECT_EQ(motion.counters().accepted, static_cast<std::uint64_t>(kSamples));
  EXPECT_EQ(motion.newest_ns(), kStart_ns + (kSamples - 1) * kMillisecond_ns);
}

}  // namespace
}  // namespace terracut::vehicle
