// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/settings/motion_choice.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

class MotionChoice : public test::InScratchFolder {
 protected:
  void SetUp() override {
    options_.dbc = folder_ / "car.dbc";
    std::ofstream(options_.dbc)
        << "BO_ 416 MOTION: 8 X\n SG_ SPEED : 7|16@0- (0.01,0) [0|0] \"km/h\" X\n"
           " SG_ YAW_RATE : 23|16@0- (0.01,0) [0|0] \"deg/s\" X\n"
           "BO_ 17 WHEELS: 8 X\n SG_ FL : 0|8@1+ (1,0) [0|0] \"\" X\n"
           " SG_ FR : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ BACK : 16|1@1+ (1,0) [0|0] \"\" X\n"
           " SG_ OK : 17|2@1+ (1,0) [0|0] \"\" X\n";
  }
  static can::CanFrame frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    can::CanFrame frame;
    frame.id = {id, false};
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    return frame;
  }
  std::string refusal(ErrorCode code) {
    const auto motion = motion_signals_of(options_);
    EXPECT_FALSE(motion);
    if (motion) return {};
    EXPECT_EQ(motion.error().code, code);
    return motion.error().message;
  }
  MotionOptions options_;
};

TEST_F(MotionChoice, TakesTheSignalsOfSimulatedDrivesByDefault) {
  auto motion = motion_signals_of(options_);
  ASSERT_TRUE(motion) << motion.error().message;
  const auto sample = motion->take(frame(416, {0x0E, 0x10, 0xFC, 0x18}));
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->speed_mps, 10, 1e-9);
  EXPECT_NEAR(sample->yaw_rate_radps, -10 * 3.14159265358979 / 180, 1e-9);
}

TEST_F(MotionChoice, TakesEverythingThatTheConfigurationCanSay) {
  options_.speed_signals = "FL, WHEELS.FR";
  options_.speed = {
      .signals = {}, .unit = "m/s", .scale = 2, .sign = "BACK", .valid = "OK", .valid_value = 2};
  options_.yaw_rate.unit = "rad/s";
  auto motion = motion_signals_of(options_);
  ASSERT_TRUE(motion) << motion.error().message;
  EXPECT_EQ(motion->ids().size(), 2U);
  EXPECT_FALSE(motion->take(frame(17, {3, 5, 0b101})));
  const auto sample = motion->take(frame(416, {0, 0, 0, 50}));
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->speed_mps, -8, 1e-9);
  EXPECT_NEAR(sample->yaw_rate_radps, 0.5, 1e-9);
  EXPECT_FALSE(motion->take(frame(17, {3, 5, 0b011})));
  EXPECT_FALSE(motion->take(frame(416, {0, 0, 0, 50}))) << "not valid any more";
}

TEST_F(MotionChoice, SaysWhatIsMissingAndWhereItIsSaid) {
  options_.speed_signals = ",FL";
  EXPECT_THAT(refusal(ErrorCode::kInvalidArgument), HasSubstr("no signal ''"));
  options_.speed_signals = "V";
  EXPECT_THAT(refusal(ErrorCode::kInvalidArgument),
              AllOf(HasSubstr("speed: "), HasSubstr("no signal 'V'"), HasSubstr("below motion")));
  options_.speed_signals = "FL";
  EXPECT_THAT(refusal(ErrorCode::kInvalidArgument), HasSubstr("FL has no unit"));
  options_.speed_signals = "SPEED";
  options_.timeout_ms = 50;
  EXPECT_THAT(refusal(ErrorCode::kInvalidArgument), HasSubstr("timeout 0.05 s"));
  options_.dbc = folder_ / "none.dbc";
  EXPECT_THAT(refusal(ErrorCode::kNotFound), HasSubstr("none.dbc"));
  options_.dbc.clear();
  EXPECT_THAT(refusal(ErrorCode::kInvalidArgument), HasSubstr("motion.dbc"));
}

}  // namespace
}  // namespace terracut::cli
