// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/motion_signals.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "firmware_io/vehicle/motion_units.hpp"
#include "tests/firmware_io/can/frames.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using can::CanId;
using testing::ElementsAre;
using testing::HasSubstr;
using vehicle::MotionCounters;
using vehicle::MotionSample;
using vehicle::MotionSignals;
using vehicle::MotionSignalsConfig;

// One signal a byte or two, so that frames can be written by hand.
constexpr std::string_view kCar = R"(BO_ 1 WHEELS: 8 X
 SG_ FL : 0|16@1+ (0.01,0) [0|0] "km/h" X
 SG_ FR : 16|16@1+ (0.01,0) [0|0] "km/h" X
 SG_ RL : 32|16@1+ (0.01,0) [0|0] "" X
 SG_ BACKWARDS : 48|1@1+ (1,0) [0|0] "" X
 SG_ QUALITY : 56|2@1+ (1,0) [0|0] "" X
BO_ 2147483650 YAW: 4 X
 SG_ RATE : 0|16@1- (0.01,0) [0|0] "deg/s" X
 SG_ RATE_SIGN : 16|1@1+ (1,0) [0|0] "" X
 SG_ RATE_VALID : 17|1@1+ (1,0) [0|0] "" X
BO_ 3 OTHER: 4 X
 SG_ FLOAT_SPEED : 0|32@1- (1,0) [0|0] "m/s" X
 SG_ m m0 : 0|8@1+ (1,0) [0|0] "m/s" X
SIG_VALTYPE_ 3 FLOAT_SPEED : 1;
)";
constexpr CanId kWheels{1, false}, kYaw{2, true}, kOther{3, false};
constexpr std::int64_t kMillisecond_ns = 1'000'000;

MotionSignalsConfig plain() {
  MotionSignalsConfig config;
  config.speed.signals = {"WHEELS.FL"};
  config.yaw_rate.signals = {"RATE"};
  return config;
}

Expected<MotionSignals> make(const MotionSignalsConfig& config) {
  const auto file = vehicle::parse_dbc(kCar, "car.dbc");
  EXPECT_TRUE(file) << file.error().message;
  return MotionSignals::make(*file, config);
}

class MotionSignalsTest : public testing::Test {
 protected:
  void open(const MotionSignalsConfig& config) {
    auto made = make(config);
    ASSERT_TRUE(made) << made.error().message;
    motion_.emplace(*std::move(made));
  }
  /// Two wheels in hundredths of a km/h.
  std::optional<MotionSample> wheels(std::int64_t ms, int left, int right = 0, int behind = 0,
                                     int backwards = 0, int quality = 0) {
    const auto low = [](int value) { return static_cast<std::uint8_t>(value & 0xFF); };
    const auto high = [](int value) { return static_cast<std::uint8_t>(value >> 8 & 0xFF); };
    return motion_->take(data_frame(kWheels,
                                    {low(left), high(left), low(right), high(right), low(behind),
                                     high(behind), low(backwards), low(quality)},
                                    ms * kMillisecond_ns));
  }
  /// Yaw rate in hundredths of a deg/s.
  std::optional<MotionSample> yaw(std::int64_t ms, int rate, int bits = 0b10) {
    return motion_->take(data_frame(
        kYaw,
        {static_cast<std::uint8_t>(rate & 0xFF), static_cast<std::uint8_t>(rate >> 8 & 0xFF),
         static_cast<std::uint8_t>(bits), 0},
        ms * kMillisecond_ns));
  }
  [[nodiscard]] const MotionCounters& counters() const { return motion_->counters(); }
  void TearDown() override {
    if (motion_) {
      EXPECT_LE(counters().samples + counters().yaw_rate_invalid + counters().speed_invalid +
                    counters().stale,
                counters().frames);
    }
  }

  std::optional<MotionSignals> motion_;
};

TEST_F(MotionSignalsTest, MakesASampleOfEachYawRateWithTheNewestSpeed) {
  open(plain());
  EXPECT_THAT(motion_->ids(), ElementsAre(kWheels, kYaw));
  EXPECT_FALSE(yaw(1000, 100)) << "there is no speed yet";
  EXPECT_FALSE(wheels(1010, 3600));
  const auto sample = yaw(1020, -900);
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->stamp_ns, 1020 * kMillisecond_ns);
  EXPECT_NEAR(sample->speed_mps, 10, 1e-12);
  EXPECT_NEAR(sample->yaw_rate_radps, -9 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(counters().frames, 3U);
  EXPECT_EQ(counters().samples, 1U);
  EXPECT_EQ(counters().stale, 1U);
}

TEST_F(MotionSignalsTest, TakesTheMeanOfSeveralWheels) {
  auto config = plain();
  config.speed.signals = {"FL", "FR"};
  open(config);
  wheels(0, 3600, 7200);
  EXPECT_NEAR(yaw(1, 0)->speed_mps, 15, 1e-12);
}

TEST_F(MotionSignalsTest, TakesTheUnitOfTheConfigurationBeforeThatOfTheFile) {
  auto config = plain();
  config.speed.signals = {"RL"};  // has no unit in the file
  config.speed.unit = "mph";
  config.yaw_rate.unit = "rad/s";
  open(config);
  wheels(0, 0, 0, 10000);
  const auto sample = yaw(1, 50);
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->speed_mps, 44.704, 1e-9);
  EXPECT_NEAR(sample->yaw_rate_radps, 0.5, 1e-12);
}

TEST_F(MotionSignalsTest, TakesSignsFromSignalsOfTheirOwnAndReversesThem) {
  auto config = plain();
  config.speed.sign = "BACKWARDS";
  config.yaw_rate.sign = "RATE_SIGN";
  config.yaw_rate.scale = -1;
  open(config);
  wheels(0, 3600, 0, 0, 1);
  EXPECT_NEAR(yaw(1, 100, 0)->speed_mps, -10, 1e-12);
  EXPECT_LT(yaw(2, 100, 0)->yaw_rate_radps, 0);
  EXPECT_GT(yaw(3, 100, 1)->yaw_rate_radps, 0) << "both reverse it";
  wheels(4, 3600, 0, 0, 0);
  EXPECT_NEAR(yaw(5, 100)->speed_mps, 10, 1e-12);
}

TEST_F(MotionSignalsTest, MakesNoSampleOfWhatItsOwnSignalCallsInvalid) {
  auto config = plain();
  config.speed.valid = "QUALITY";
  config.speed.valid_value = 3;
  config.yaw_rate.valid = "RATE_VALID";
  open(config);
  wheels(0, 3600, 0, 0, 0, 3);
  EXPECT_TRUE(yaw(1, 100, 0b10));
  EXPECT_FALSE(yaw(2, 100, 0b00));
  EXPECT_EQ(counters().yaw_rate_invalid, 1U);
  wheels(3, 3600, 0, 0, 0, 2);
  EXPECT_FALSE(yaw(4, 100, 0b10));
  EXPECT_EQ(counters().speed_invalid, 1U);
  wheels(5, 3600, 0, 0, 0, 3);
  EXPECT_TRUE(yaw(6, 100, 0b10));
  EXPECT_EQ(counters().samples, 2U);
}

TEST_F(MotionSignalsTest, MakesNoSampleWhereWhatCallsItValidIsTooOld) {
  auto config = plain();
  config.max_age_s = 0.1;
  config.speed.signals = {"FLOAT_SPEED"};
  config.yaw_rate.valid = "QUALITY";  // in a frame of its own
  config.yaw_rate.valid_value = 3;
  open(config);
  const auto speed = [&](std::int64_t ms) {
    return motion_->take(data_frame(kOther, {0, 0, 0x20, 0x41}, ms * kMillisecond_ns));
  };
  wheels(0, 0, 0, 0, 0, 3);
  speed(1);
  EXPECT_TRUE(yaw(2, 100));
  speed(200);
  EXPECT_FALSE(yaw(201, 100));
  EXPECT_EQ(counters().stale, 1U);
}

TEST_F(MotionSignalsTest, MakesNoSampleOfASpeedThatIsNoNumber) {
  auto config = plain();
  config.speed.signals = {"FLOAT_SPEED"};
  open(config);
  EXPECT_FALSE(motion_->take(data_frame(kOther, {0, 0, 0xC0, 0x7F}, 0)));
  EXPECT_FALSE(yaw(1, 0));
  EXPECT_EQ(counters().speed_invalid, 1U);
  EXPECT_FALSE(motion_->take(data_frame(kOther, {0, 0, 0x20, 0x41}, 2 * kMillisecond_ns)));
  EXPECT_EQ(yaw(3, 0)->speed_mps, 10);
}

TEST_F(MotionSignalsTest, MakesNoSampleOfWhatIsTooOld) {
  auto config = plain();
  config.max_age_s = 0.1;
  open(config);
  wheels(0, 3600);
  EXPECT_TRUE(yaw(100, 0));
  EXPECT_FALSE(yaw(101, 0));
  EXPECT_EQ(counters().stale, 1U);
  wheels(102, 3600);
  EXPECT_TRUE(yaw(103, 0));
}

TEST_F(MotionSignalsTest, CountsEachTimeTheMotionWasLost) {
  auto config = plain();
  config.timeout_s = 0.5;
  open(config);
  EXPECT_FALSE(motion_->alive(0)) << "nothing was known yet";
  EXPECT_EQ(counters().timeouts, 0U);
  wheels(0, 3600);
  yaw(10, 0);
  EXPECT_TRUE(motion_->alive(510 * kMillisecond_ns));
  EXPECT_FALSE(motion_->alive(511 * kMillisecond_ns));
  EXPECT_FALSE(motion_->alive(600 * kMillisecond_ns));
  EXPECT_EQ(counters().timeouts, 1U);
  wheels(700, 3600);
  yaw(710, 0);
  EXPECT_TRUE(motion_->alive(711 * kMillisecond_ns));
  EXPECT_EQ(counters().timeouts, 1U);
  wheels(1300, 3600);
  yaw(1310, 0);
  EXPECT_EQ(counters().timeouts, 2U) << "nobody asked meanwhile";
}

TEST_F(MotionSignalsTest, LeavesOutWhatIsOutOfOrderAndResetsAllWhenTheClockIsSetBack) {
  open(plain());
  wheels(1000, 3600);
  EXPECT_TRUE(yaw(1010, 0));
  EXPECT_FALSE(yaw(990, 0));
  EXPECT_EQ(counters().out_of_order, 1U);
  EXPECT_EQ(counters().clock_set_back, 0U);
  EXPECT_FALSE(yaw(989, 0)) << "the speed is of the time before";
  EXPECT_EQ(counters().clock_set_back, 1U);
  EXPECT_FALSE(motion_->alive(990 * kMillisecond_ns));
  wheels(995, 3600);
  EXPECT_TRUE(yaw(996, 0)) << "less than a timeout after the clock was set";
  EXPECT_TRUE(motion_->alive(996 * kMillisecond_ns));
}

TEST_F(MotionSignalsTest, CountsSignalsThatTheirFrameHasNoRoomFor) {
  open(plain());
  EXPECT_FALSE(motion_->take(data_frame(kWheels, {1}, 0)));
  EXPECT_FALSE(motion_->take(data_frame(kYaw, {}, 1)));
  EXPECT_EQ(counters().too_short, 2U);
  EXPECT_EQ(counters().frames, 2U);
}

TEST_F(MotionSignalsTest, IsNotChangedByOtherFrames) {
  open(plain());
  wheels(0, 3600);
  CanFrame frame = data_frame({2, false}, {1, 2, 3, 4}, kMillisecond_ns);  // the other format
  EXPECT_FALSE(motion_->take(frame));
  frame.id = kYaw;
  frame.remote = true;
  EXPECT_FALSE(motion_->take(frame));
  frame.remote = false;
  frame.error = true;
  EXPECT_FALSE(motion_->take(frame));
  EXPECT_EQ(counters().frames, 1U);
}

TEST(MotionSignals, RefusesWhatCannotBeMeantByName) {
  const auto refused = [](auto&& change, ErrorCode code = ErrorCode::kInvalidArgument) {
    MotionSignalsConfig config = plain();
    change(config);
    const auto motion = make(config);
    EXPECT_FALSE(motion);
    if (motion) return std::string();
    EXPECT_EQ(motion.error().code, code);
    return motion.error().message;
  };
  EXPECT_THAT(refused([](auto& c) { c.speed.signals = {}; }), HasSubstr("speed: 0 signals"));
  EXPECT_THAT(refused([](auto& c) { c.speed.signals.assign(9, "FL"); }), HasSubstr("1 to 8"));
  EXPECT_THAT(refused([](auto& c) { c.speed.signals = {"SPEED"}; }),
              HasSubstr("speed: car.dbc: no signal 'SPEED'"));
  EXPECT_THAT(refused([](auto& c) { c.yaw_rate.sign = "NONE"; }), HasSubstr("yaw rate: car.dbc"));
  EXPECT_THAT(refused([](auto& c) { c.yaw_rate.valid = "NONE"; }), HasSubstr("'NONE'"));
  EXPECT_THAT(refused([](auto& c) { c.speed.signals = {"RL"}; }),
              HasSubstr("speed: signal RL has no unit; expected m/s, km/h or mph"));
  EXPECT_THAT(refused([](auto& c) { c.speed.unit = "knots"; }), HasSubstr("'knots'"));
  EXPECT_THAT(refused([](auto& c) { c.yaw_rate.unit = "m/s"; }), HasSubstr("rad/s or deg/s"));
  EXPECT_THAT(refused([](auto& c) { c.speed.scale = 0; }), HasSubstr("scale 0"));
  EXPECT_THAT(refused([](auto& c) { c.speed.scale = NAN; }), HasSubstr("scale nan"));
  EXPECT_THAT(refused([](auto& c) { c.max_age_s = 0; }), HasSubstr("max_age 0 s"));
  EXPECT_THAT(refused([](auto& c) { c.max_age_s = NAN; }), HasSubstr("max_age nan s"));
  EXPECT_THAT(refused([](auto& c) { c.timeout_s = 0.05; }), HasSubstr("timeout 0.05 s"));
  EXPECT_THAT(refused([](auto& c) { c.max_age_s = c.timeout_s = 10.5; }),
              HasSubstr("max_age 10.5 s: expected a time from 0.001 to 10 s"));
  EXPECT_THAT(refused([](auto& c) { c.timeout_s = 60.5; }), HasSubstr("timeout 60.5 s"));
  EXPECT_THAT(refused([](auto& c) { c.speed.signals = {"m"}; }, ErrorCode::kUnsupported),
              HasSubstr("multiplexed"));
}

TEST(MotionSignals, TheShortestAndTheLongestTimesAreTaken) {
  MotionSignalsConfig config = plain();
  config.max_age_s = config.timeout_s = 0.001;
  EXPECT_TRUE(make(config));
  config.max_age_s = config.timeout_s = 10;
  EXPECT_TRUE(make(config));
  config.timeout_s = 60;
  EXPECT_TRUE(make(config));
}

TEST(MotionUnits, KnowsTheUnitsOfCarsInTheirSpellings) {
  using vehicle::metres_per_second_in;
  using vehicle::radians_per_second_in;
  for (const char* unit : {"km/h", "KM/H", "kph", " km / h"}) {
    EXPECT_NEAR(metres_per_second_in(unit).value() * 36, 10, 1e-12) << unit;
  }
  EXPECT_EQ(metres_per_second_in("m/s").value(), 1);
  EXPECT_NEAR(metres_per_second_in("mph").value(), 0.44704, 1e-12);
  for (const char* unit : {"deg/s", "\xC2\xB0/s", "\xB0/s", "degrees/s"}) {
    EXPECT_NEAR(radians_per_second_in(unit).value() * 180, std::numbers::pi, 1e-12) << unit;
  }
  EXPECT_EQ(radians_per_second_in("rad/s").value(), 1);
  EXPECT_FALSE(metres_per_second_in("rad/s"));
  EXPECT_FALSE(radians_per_second_in("km/h"));
}

}  // namespace
}  // namespace terracut::test
