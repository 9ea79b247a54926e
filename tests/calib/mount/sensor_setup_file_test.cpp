// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/sensor_setup_file.hpp"

#include <cmath>
#include <numbers>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::mount {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Expected<SensorSetup> parsed(const std::string& text) {
  return parse_sensor_setup(text, "car.yaml");
}

TEST(SensorSetup, ReadsBackWhatItWrote) {
  const test::ScratchFolder folder;
  const SensorSetup setup{{1.78, beams::deg_to_rad(0.25), beams::deg_to_rad(-1.5)},
                          {3.7, 4.25, 1e3, INFINITY}};
  ASSERT_TRUE(write_sensor_setup(folder / "car.yaml", setup));
  const auto read = read_sensor_setup(folder / "car.yaml");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_NEAR(read->mount.height_m, 1.78, 1e-9);
  EXPECT_NEAR(read->mount.roll_rad, beams::deg_to_rad(0.25), 1e-9);
  EXPECT_NEAR(read->mount.pitch_rad, beams::deg_to_rad(-1.5), 1e-9);
  EXPECT_EQ(read->ring_ground_distance_m, setup.ring_ground_distance_m);
  EXPECT_EQ(folder.files(), 1U);
}

TEST(SensorSetup, AMountAloneIsEnoughAndSoIsItsHeight) {
  const auto read = parsed("mount:\n  height_m: 2.1\n");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->mount.height_m, 2.1);
  EXPECT_EQ(read->mount.roll_rad, 0);
  EXPECT_TRUE(read->ring_ground_distance_m.empty());
}

TEST(SensorSetup, HoldsASensorUpsideDown) {
  const auto read = parsed("mount: {height_m: 2.1, roll_deg: 180, pitch_deg: -90}");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->mount.roll_rad, std::numbers::pi);
  EXPECT_EQ(read->mount.pitch_rad, -std::numbers::pi / 2);
}

TEST(SensorSetup, UnknownKeysAreErrorsWithTheirLine) {
  EXPECT_THAT(parsed("mount: {height_m: 2}\n\nheigth_m: 3\n"),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("car.yaml: line 3"), HasSubstr("\"heigth_m\""),
                                         HasSubstr("mount, rings"))));
  EXPECT_THAT(parsed("mount:\n  height_m: 2\n  yaw_deg: 3\n"),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("line 3"), HasSubstr("yaw_deg"))));
}

TEST(SensorSetup, RefusesValuesOutOfRangeWithTheirLine) {
  EXPECT_THAT(
      parsed("mount:\n  height_m: 0.1\n"),
      calib::IsRefusedWith(ErrorCode::kMalformed,
                           AllOf(HasSubstr("line 2"), HasSubstr("height_m"), HasSubstr("0.2"))));
  for (const char* bad :
       {"mount: {height_m: .nan}", "mount: {height_m: 2, pitch_deg: 91}",
        "mount: {height_m: 2, roll_deg: 181}", "mount: {height_m: 2, roll_deg: .inf}",
        "mount: {height_m: two}", "mount: {height_m: [2]}", "mount: {roll_deg: 2}", "mount: 2",
        "mount: {height_m: 2, height_m: 2}", "rings: {ground_distance_m: [1]}",
        "mount: {height_m: 2}\nrings: {ground_distance_m: []}",
        "mount: {height_m: 2}\nrings: {ground_distance_m: [-1]}",
        "mount: {height_m: 2}\nrings: {ground_distance_m: [.nan]}",
        "mount: {height_m: 2}\nrings: {ground_distance_m: [0]}",
        "mount: {height_m: 2}\nrings: {ground_distance_m: [-.inf]}", "", "[]", "{[1]: 2}"}) {
    EXPECT_FALSE(parsed(bad).has_value()) << bad;
  }
}

TEST(SensorSetup, RefusesToWriteWhatItWouldNotRead) {
  const test::ScratchFolder folder;
  EXPECT_THAT(write_sensor_setup(folder / "car.yaml", SensorSetup{{.height_m = -1}, {}}),
              calib::IsRefusedWith(ErrorCode::kInvalidArgument, HasSubstr("height_m")));
  EXPECT_EQ(folder.files(), 0U);
}

TEST(SensorSetup, GoesIntoAProfileOfTheSameNumberOfRings) {
  RingProfile profile = ring_profile(hdl64e::nominal_hdl64e(), Mount{});
  SensorSetup setup{{.height_m = 2.2}, std::vector<double>(64, 7.5)};
  ASSERT_TRUE(apply_setup(setup, profile));
  EXPECT_EQ(profile.mount.height_m, 2.2);
  for (const Ring& ring : profile.rings) EXPECT_EQ(ring.ground_distance_m, 7.5);
  setup.ring_ground_distance_m.pop_back();
  EXPECT_THAT(apply_setup(setup, profile),
              calib::IsRefusedWith(ErrorCode::kInvalidArgument, HasSubstr("64 rings, found 63")));
}

}  // namespace
}  // namespace terracut::mount
