// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/motion_compensation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>
#include <string>

#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/encode/sensor_motion.hpp"

namespace terracut::encode {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Compensates as KITTI did, written from its definition: integrates the motion in small steps.
scan::ScanPoint compensated(const SensorTwist& twist, const scan::ScanPoint& p) {
  const double share = std::atan2(-double{p.y_m}, double{p.x_m}) / (2 * std::numbers::pi);
  const double seconds = share * twist.frame_duration_s;
  const Eigen::Vector3d w(twist.angular_velocity_rad_s.data()), v(twist.velocity_m_s.data());
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  constexpr int kSteps = 2000;
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d rotated = w * (seconds / kSteps);
  step.linear() = Eigen::AngleAxisd(rotated.norm(), rotated.normalized()).toRotationMatrix();
  step.translation() = v * (seconds / kSteps);
  for (int i = 0; i < kSteps; ++i) moved = moved * step;
  const Eigen::Vector3d q = moved * Eigen::Vector3d(p.x_m, p.y_m, p.z_m);
  return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), 0};
}

TEST(MotionCompensation, UndoneIsWhatTheSensorMeasured) {
  SensorTwist twist{{0.02, -0.03, 0.45}, {13, -0.4, 0.3}, 0.1037};
  for (const double distance_m : {3.0, 7.0, 60.0}) {
    for (int degree = -179; degree < 180; degree += 7) {
      const double azimuth = beams::deg_to_rad(degree);
      const scan::ScanPoint measured{static_cast<float>(distance_m * std::cos(azimuth)),
                                     static_cast<float>(distance_m * std::sin(azimuth)), -1.5F, 0};
      std::vector<scan::ScanPoint> points{compensated(twist, measured)};
      undo_motion_compensation(twist, points);
      EXPECT_NEAR(points[0].x_m, measured.x_m, 2e-3) << degree << " deg, " << distance_m << " m";
      EXPECT_NEAR(points[0].y_m, measured.y_m, 2e-3) << degree << " deg, " << distance_m << " m";
      EXPECT_NEAR(points[0].z_m, measured.z_m, 1e-3) << degree << " deg, " << distance_m << " m";
    }
  }
}

TEST(MotionCompensation, ChangesNothingStraightAheadOrAtRest) {
  std::vector<scan::ScanPoint> ahead{{20, 0, -1, 0}};
  undo_motion_compensation({{0, 0, 0.4}, {15, 0, 0}, 0.1}, ahead);
  EXPECT_FLOAT_EQ(ahead[0].x_m, 20);
  auto points = synthetic::scan(synthetic::table());
  const auto before = points;
  undo_motion_compensation({}, points);
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(points[i].x_m, before[i].x_m);
}

TEST(MotionCompensation, LeavesPointsThatAreNoPlaceAlone) {
  std::vector<scan::ScanPoint> points{{std::numeric_limits<float>::infinity(), 1, 2, 0}};
  undo_motion_compensation({{0, 0, 0.4}, {15, 0, 0}, 0.1}, points);
  EXPECT_TRUE(std::isinf(points[0].x_m));
  EXPECT_EQ(points[0].y_m, 1);
}

/// Camera looks along the car: its z is forward, its x right. 10 m/s forward, turning left.
constexpr const char* kPoses =
    "1 0 0 0 0 1 0 0 0 0 1 0\n"
    "1 0 0 0 0 1 0 0 0 0 1 1\n"
    "1 0 0 0 0 1 0 0 0 0 1 2\n";
constexpr const char* kTimes = "0\n0.1\n0.2\n";

TEST(SensorMotion, TakesVelocityIntoTheSensorsFrame) {
  const test::ScratchFolder folder;
  const auto motion = SensorMotion::read(folder.write("poses.txt", kPoses),
                                         folder.write("times.txt", kTimes), std::nullopt);
  ASSERT_TRUE(motion) << motion.error().message;
  EXPECT_EQ(motion->frames(), 3U);
  for (const std::uint32_t frame : {0U, 1U, 2U}) {
    const auto twist = motion->twist(frame);
    ASSERT_TRUE(twist);
    EXPECT_NEAR(twist->velocity_m_s[0], 10, 1e-9);
    EXPECT_NEAR(twist->velocity_m_s[1], 0, 1e-9);
    EXPECT_NEAR(twist->frame_duration_s, 0.1, 1e-12);
  }
}

TEST(SensorMotion, FollowsACurve) {
  // Turning left at 0.5 rad/s about the sensor, which stands 0.27 m behind the camera.
  const test::ScratchFolder folder;
  std::string poses;
  for (int i = 0; i < 3; ++i) {
    const double a = 0.05 * i, c = std::cos(a), s = std::sin(a);  // about -y of the camera
    const double x = -0.27 * s, z = 0.27 * c - 0.27;
    poses += std::to_string(c) + " 0 " + std::to_string(-s) + " " + std::to_string(x) +
             " 0 1 0 0 " + std::to_string(s) + " 0 " + std::to_string(c) + " " + std::to_string(z) +
             "\n";
  }
  const auto motion = SensorMotion::read(folder.write("poses.txt", poses),
                                         folder.write("times.txt", kTimes), std::nullopt);
  ASSERT_TRUE(motion);
  const auto twist = motion->twist(1);
  ASSERT_TRUE(twist);
  EXPECT_NEAR(twist->angular_velocity_rad_s[2], 0.5, 1e-4);
  for (const double v : twist->velocity_m_s) EXPECT_NEAR(v, 0, 1e-3);
}

TEST(SensorMotion, TakesTheSensorsPlaceFromTheCalibration) {
  const test::ScratchFolder folder;
  // Sensor axes = camera axes: the velocity stays along z.
  const auto calib = folder.write("calib.txt", "P0: 1 2 3\nTr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto motion = SensorMotion::read(folder.write("poses.txt", kPoses),
                                         folder.write("times.txt", kTimes), calib);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->twist(1)->velocity_m_s[2], 10, 1e-9);
}

TEST(SensorMotion, TakesWhatOneFrameSeesToWhereAnotherSeesIt) {
  const test::ScratchFolder folder;
  const auto calib = folder.write("calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto motion = SensorMotion::read(folder.write("poses.txt", kPoses),
                                         folder.write("times.txt", kTimes), calib);
  ASSERT_TRUE(motion);
  const RigidMotion onward = motion->between(0, 1).value(), back = motion->between(1, 0).value();
  EXPECT_LT(onward[11], -0.5);  // what stands comes nearer
  EXPECT_NEAR(onward[11], -back[11], 1e-9);
  EXPECT_FALSE(motion->between(0, 1000));
}

TEST(SensorMotion, RefusesFramesItHasNoPoseOf) {
  const test::ScratchFolder folder;
  const auto motion = SensorMotion::read(folder.write("poses.txt", kPoses),
                                         folder.write("times.txt", kTimes), std::nullopt);
  ASSERT_TRUE(motion);
  const auto twist = motion->twist(3);
  ASSERT_FALSE(twist);
  EXPECT_THAT(twist.error().message, AllOf(HasSubstr("frames 0 to 2"), HasSubstr("scan 3")));
}

struct Malformed {
  const char* what;
  const char* poses;
  const char* times;
  const char* calib;
  const char* message;
};

class SensorMotionFiles : public testing::TestWithParam<Malformed> {};

TEST_P(SensorMotionFiles, AreRefusedByFileAndLine) {
  const test::ScratchFolder folder;
  const auto motion = SensorMotion::read(folder.write("poses.txt", GetParam().poses),
                                         folder.write("times.txt", GetParam().times),
                                         folder.write("calib.txt", GetParam().calib));
  ASSERT_FALSE(motion);
  EXPECT_EQ(motion.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(motion.error().message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Malformed, SensorMotionFiles,
    testing::Values(Malformed{"eleven", "1 0 0 0 0 1 0 0 0 0 1\n", kTimes, "", "poses.txt, line 1"},
                    Malformed{"words", kPoses, "0\nten\n0.2\n", "",
                              "times.txt, line 2: expected 1 finite number"},
                    Malformed{"nan", kPoses, "0\nnan\n0.2\n", "", "times.txt, line 2"},
                    Malformed{"unequal", kPoses, "0\n0.1\n", "", "3 poses"},
                    Malformed{"standing", kPoses, "0\n0.1\n0.1\n", "", "the time of frame 2"},
                    Malformed{"empty", "", "", "", "0 poses"},
                    Malformed{"extrinsics", kPoses, kTimes, "P0: 1\nTr: 1 2\n",
                              "calib.txt, line 2"}),
    [](const auto& param) { return param.param.what; });

TEST(SensorMotion, RefusesSpeedsNoCarHas) {
  const test::ScratchFolder folder;
  const auto motion =
      SensorMotion::read(folder.write("poses.txt", kPoses),
                         folder.write("times.txt", "0\n0.001\n0.002\n"), std::nullopt);
  ASSERT_TRUE(motion);
  const auto twist = motion->twist(1);
  ASSERT_FALSE(twist);
  EXPECT_THAT(twist.error().message, HasSubstr("faster than any car"));
}

}  // namespace
}  // namespace terracut::encode
