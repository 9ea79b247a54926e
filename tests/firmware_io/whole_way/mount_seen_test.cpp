// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the near ground of drives and scans says of the mount: right ones are not contradicted, and
// wrong ones are.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>

#include "calib/angle.hpp"
#include "calib/mount_check.hpp"
#include "firmware_io/hdl64e/hdl64e_transmitter.hpp"
#include "firmware_io/ruby128/ruby128_transmitter.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "firmware_io/simulator/drive.hpp"
#include "pipeline/near_ground.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"

namespace terracut::firmware_io {
namespace {

/// Drives three turns with the sensor on `truth` and looks at each as if it stood on `given`.
template <class Transmitter>
calib::MountCheck check_of_drive(const std::string& scene, const calib::Mount& truth,
                                 const calib::Mount& given) {
  SimulationConfig<Transmitter> config;
  config.scene = scene;
  config.duration_s = 0.3;
  config.mount = truth;
  calib::MountCheck check(given);
  const calib::RigidTransform T = calib::T_vehicle_lidar(given);
  std::vector<std::array<float, 3>> points;
  double turn_ends_s = 0.1;
  const auto done = simulate_drive(config, [&](const SimulatedColumn<Transmitter>& column) {
    if (column.time_s >= turn_ends_s) {
      check.add_turn(points);
      points.clear();
      turn_ends_s += 0.1;
    }
    for (std::size_t laser = 0; laser < column.exact.size(); ++laser) {
      if (column.wire.by_laser[laser].raw == 0) continue;
      const calib::Point& p = column.exact[laser];
      const auto [x, y, z] = calib::apply(T, p.x_m, p.y_m, p.z_m);
      const auto x_m = static_cast<float>(x), y_m = static_cast<float>(y);
      if (!pipeline::is_near_ground_place(x_m, y_m)) continue;
      points.push_back({x_m, y_m, static_cast<float>(z)});
    }
    return Status{};
  });
  EXPECT_TRUE(done) << done.error().message;
  EXPECT_EQ(check.turns(), 3U);
  return check;
}

class MountSeen : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(MountSeen, IsNotContradictedWhereItIsTheRightOne) {
  const auto [scene, height_m] = GetParam();
  calib::Mount mount;
  mount.height_m = height_m;
  EXPECT_FALSE(check_of_drive<Hdl64eTransmitter>(scene, mount, mount).contradiction());
  mount.height_m = 3.8 - height_m;
  EXPECT_FALSE(check_of_drive<Ruby128Transmitter>(scene, mount, mount).contradiction());
}

INSTANTIATE_TEST_SUITE_P(Scenes, MountSeen,
                         testing::Values(std::tuple("flat", 0.8), std::tuple("street", 1.73),
                                         std::tuple("highway", 3.0), std::tuple("rural", 0.8),
                                         std::tuple("hill", 1.73)),
                         [](const auto& param) { return std::string(std::get<0>(param.param)); });

TEST(MountSeenWrong, IsSaidAfterThreeTurnsWithWhatTheGroundShows) {
  const calib::Mount given;
  for (const calib::Mount& truth : {calib::Mount{0.5, 0, 0}, calib::Mount{1.2, 0, 0},
                                    calib::Mount{1.73, 0, calib::deg_to_rad(10)}}) {
    const auto seen = check_of_drive<Hdl64eTransmitter>("street", truth, given).contradiction();
    ASSERT_TRUE(seen) << truth.height_m << " " << truth.pitch_rad;
    EXPECT_NEAR(seen->height_m, truth.height_m, 0.1);
    EXPECT_NEAR(seen->pitch_rad, truth.pitch_rad, calib::deg_to_rad(1));
    EXPECT_NEAR(seen->roll_rad, 0, calib::deg_to_rad(2));
  }
}

TEST(MountSeenInScans, IsNotContradictedAtItsPublishedHeight) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    auto reader = ScanReader::open(sequence);
    ASSERT_TRUE(reader);
    rt::FixedMemory memory;
    pipeline::RangeImage image(pipeline::ImageShape{}, 40'000, memory);
    const auto ground = std::make_unique<pipeline::NearGround>();
    for (const double given_m : {1.73, 1.2}) {
      calib::Mount mount;
      mount.height_m = given_m;
      ScanToImage to_image(mount);
      calib::MountCheck check(mount);
      KittiScan scan;
      RingRecovery rings;
      // Of some sequences there are two scans only: each three times makes enough turns.
      for (std::size_t i = 0; i < 3 * reader->size(); ++i) {
        ASSERT_TRUE(reader->read(i % reader->size(), scan, rings));
        to_image.place(scan.points, rings.ring_of_point, image);
        pipeline::take_near_ground(image, *ground);
        check.add_turn(ground->in_use());
      }
      EXPECT_EQ(check.contradiction().has_value(), given_m != 1.73) << sequence << " " << given_m;
    }
  }
}

}  // namespace
}  // namespace terracut::firmware_io
