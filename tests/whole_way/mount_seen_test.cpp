// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the near ground of drives and scans says of the mount: right ones are not contradicted, and
// wrong ones are.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/mount/mount_check.hpp"
#include "drive_near_ground.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tools/lab/encode/scan_reader.hpp"
#include "tools/lab/packets/hdl64e_encoder_traits.hpp"
#include "tools/lab/packets/ruby128_encoder_traits.hpp"

namespace terracut::whole_way {
namespace {

/// Drives three frames with the sensor on `truth` and looks at each as if it stood on each of
/// `given`.
template <class EncoderTraits>
std::vector<mount::MountCheck> checks_of_drive(const std::string& scene, const mount::Mount& truth,
                                               const std::vector<mount::Mount>& given) {
  std::vector<mount::MountCheck> checks(given.begin(), given.end());
  drive_frames<EncoderTraits>(scene, truth, 3, [&](const DriveFrame& points) {
    for (mount::MountCheck& check : checks) check.add_frame(near_ground_of(points, check.mount()));
  });
  return checks;
}

struct Drive {
  const char* scene;
  double hdl64e_m, ruby128_m;  ///< Heights of the two sensors.
};

class MountSeen : public testing::TestWithParam<Drive> {
 protected:
  template <class EncoderTraits>
  void tell_apart(double height_m) {
    const mount::Mount right{height_m, 0, 0};
    const double roll_rad = beams::deg_to_rad(4), pitch_rad = beams::deg_to_rad(3);
    const auto checks = checks_of_drive<EncoderTraits>(GetParam().scene, right,
                                                       {right,
                                                        {height_m - 0.3, 0, 0},
                                                        {height_m + 0.3, 0, 0},
                                                        {height_m + 1, 0, 0},
                                                        {height_m, -roll_rad, 0},
                                                        {height_m, roll_rad, 0},
                                                        {height_m, 0, -pitch_rad},
                                                        {height_m, 0, pitch_rad},
                                                        {height_m, 0, beams::deg_to_rad(10)}});
    EXPECT_FALSE(checks.front().contradiction()) << "the right one";
    for (std::size_t i = 1; i < checks.size(); ++i) {
      EXPECT_EQ(checks[i].frames(), 3U);
      const auto seen = checks[i].contradiction();
      ASSERT_TRUE(seen) << i;
      EXPECT_NEAR(seen->height_m, right.height_m, 0.1) << i;
      EXPECT_NEAR(seen->roll_rad, 0, beams::deg_to_rad(1)) << i;
      EXPECT_NEAR(seen->pitch_rad, 0, beams::deg_to_rad(1)) << i;
    }
  }
};

TEST_P(MountSeen, TellsWrongMountsFromTheRightOne) {
  tell_apart<packets::Hdl64eEncoderTraits>(GetParam().hdl64e_m);
  tell_apart<packets::Ruby128EncoderTraits>(GetParam().ruby128_m);
}

INSTANTIATE_TEST_SUITE_P(LevelScenes, MountSeen,
                         testing::Values(Drive{"flat", 0.8, 3.0}, Drive{"street", 1.73, 2.07},
                                         Drive{"highway", 3.0, 0.8}, Drive{"rural", 1.73, 3.0}),
                         [](const auto& param) { return std::string(param.param.scene); });

TEST(MountSeenWhereAHillBegins, IsNotContradictedWhereItIsTheRightOne) {
  const mount::Mount low{1.73, 0, 0}, high{3, 0, 0};
  for (const mount::MountCheck& check :
       {checks_of_drive<packets::Hdl64eEncoderTraits>("hill", low, {low}).front(),
        checks_of_drive<packets::Ruby128EncoderTraits>("hill", high, {high}).front()}) {
    EXPECT_EQ(check.frames(), 3U);
    EXPECT_FALSE(check.contradiction()) << check.mount().height_m;
  }
}

TEST(MountSeenInScans, TellsWrongMountsFromThePublishedHeight) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  const mount::Mount right;
  // The real one is pitched by 0.6 degrees more, and in one sequence the vehicle leans by 1.6.
  const double pitch_rad = beams::deg_to_rad(4), roll_rad = beams::deg_to_rad(6);
  for (const auto& sequence : sequences) {
    auto reader = encode::ScanReader::open(sequence);
    ASSERT_TRUE(reader);
    memory::FixedMemory memory;
    frame::RangeImage image(frame::ImageShape{}, 40'000, memory);
    const auto ground = std::make_unique<ground::NearGround>();
    for (const mount::Mount& given :
         {right, mount::Mount{right.height_m - 0.3, 0, 0}, mount::Mount{right.height_m + 0.3, 0, 0},
          mount::Mount{right.height_m, -roll_rad, 0}, mount::Mount{right.height_m, roll_rad, 0},
          mount::Mount{right.height_m, 0, -pitch_rad},
          mount::Mount{right.height_m, 0, pitch_rad}}) {
      scan::ScanToImage to_image(given);
      mount::MountCheck check(given);
      scan::KittiScan scan;
      scan::RingRecovery rings;
      // Of some sequences there are two scans only: each twice makes enough frames.
      for (std::size_t i = 0; i < 2 * reader->size(); ++i) {
        ASSERT_TRUE(reader->read(i % reader->size(), scan, rings));
        to_image.place(scan.points, rings.ring_of_point, image);
        ground::take_near_ground(image, *ground);
        check.add_frame(ground->in_use());
      }
      const bool is_right = given.height_m == right.height_m && given.roll_rad == right.roll_rad &&
                            given.pitch_rad == right.pitch_rad;
      EXPECT_EQ(check.contradiction().has_value(), !is_right)
          << sequence << " " << given.height_m << " " << given.roll_rad << " " << given.pitch_rad;
    }
  }
}

}  // namespace
}  // namespace terracut::whole_way
