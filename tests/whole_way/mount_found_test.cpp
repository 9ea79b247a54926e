// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The mount as the first frames of drives and scans show it.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "calib/beams/angle.hpp"
#include "calib/mount/mount_finder.hpp"
#include "drive_near_ground.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tools/lab/encode/scan_reader.hpp"
#include "tools/lab/packets/hdl64e_encoder_traits.hpp"
#include "tools/lab/packets/ruby128_encoder_traits.hpp"

namespace terracut::whole_way {
namespace {

using mount::kAtTheSensor;

struct TiltedDrive {
  const char* scene;
  double height_m, roll_deg, pitch_deg;
};

class MountFound : public testing::TestWithParam<TiltedDrive> {
 protected:
  template <class EncoderTraits>
  void find() {
    const auto& [scene, height_m, roll_deg, pitch_deg] = GetParam();
    const mount::Mount truth{height_m, beams::deg_to_rad(roll_deg), beams::deg_to_rad(pitch_deg)};
    mount::MountFinder finder;
    drive_frames<EncoderTraits>(scene, truth, 4, [&](const DriveFrame& points) {
      EXPECT_TRUE(finder.add_frame(near_ground_of(points, kAtTheSensor)));
    });
    const auto found = finder.found();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->is_certain());
    const bool is_hill = std::string(scene) == "hill";
    EXPECT_NEAR(found->mount.height_m, height_m, is_hill ? 0.08 : 0.04);
    const double half_deg = beams::deg_to_rad(is_hill ? 1.0 : 0.5);
    EXPECT_NEAR(found->mount.roll_rad, truth.roll_rad, half_deg);
    EXPECT_NEAR(found->mount.pitch_rad, truth.pitch_rad, half_deg);
    EXPECT_NEAR(found->mount.height_m, height_m, found->uncertainty.height_m);
    EXPECT_NEAR(found->mount.roll_rad, truth.roll_rad, found->uncertainty.roll_rad);
    EXPECT_NEAR(found->mount.pitch_rad, truth.pitch_rad, found->uncertainty.pitch_rad);
  }
};

TEST_P(MountFound, IsTheOneThatAnHdl64eStandsOn) {
  find<packets::Hdl64eEncoderTraits>();
}

TEST_P(MountFound, IsTheOneThatARuby128StandsOn) {
  find<packets::Ruby128EncoderTraits>();
}

INSTANTIATE_TEST_SUITE_P(Scenes, MountFound,
                         testing::Values(TiltedDrive{"flat", 0.8, 5, -5},
                                         TiltedDrive{"street", 1.73, -5, -5},
                                         TiltedDrive{"highway", 3.0, 5, 5},
                                         TiltedDrive{"rural", 0.8, -5, 5},
                                         TiltedDrive{"hill", 3.0, 5, -5}),
                         [](const auto& param) { return std::string(param.param.scene); });

TEST(MountFoundInScans, IsAboutThePublishedOne) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    auto reader = encode::ScanReader::open(sequence);
    ASSERT_TRUE(reader);
    memory::FixedMemory memory;
    frame::RangeImage image(frame::ImageShape{}, 40'000, memory);
    const auto ground = std::make_unique<ground::NearGround>();
    scan::ScanToImage to_image(kAtTheSensor);
    scan::KittiScan scan;
    scan::RingRecovery rings;
    mount::MountFinder finder;
    for (std::size_t i = 0; i < reader->size(); ++i) {
      ASSERT_TRUE(reader->read(i, scan, rings));
      to_image.place(scan.points, rings.ring_of_point, image);
      ground::take_near_ground(image, *ground);
      EXPECT_TRUE(finder.add_frame(ground->in_use())) << sequence;
    }
    const auto found = finder.found();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->is_certain()) << sequence;
    // Roads are not as level as drawings, nor loaded cars: on one of them it is 6 cm and 2.7
    // degrees of roll, and by the returns labelled road, too.
    EXPECT_NEAR(found->mount.height_m, 1.73, 0.07) << sequence;
    EXPECT_NEAR(beams::rad_to_deg(found->mount.roll_rad), 0, 3) << sequence;
    EXPECT_NEAR(beams::rad_to_deg(found->mount.pitch_rad), 0, 1) << sequence;
  }
}

}  // namespace
}  // namespace terracut::whole_way
