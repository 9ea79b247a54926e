// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/signal_plan.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "random_dbc.hpp"
#include "slow_signal.hpp"
#include "tests/firmware_io/can/frames.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using can::CanId;
using testing::HasSubstr;
using vehicle::DbcFile;
using vehicle::parse_dbc;
using vehicle::SignalPlan;

/// The plan of signal X with this definition, in a message of 8 bytes.
Expected<SignalPlan> plan_of(const std::string& definition, const std::string& behind = "",
                             const std::string& head = "BO_ 291 M: 8 NODE") {
  const auto file = parse_dbc(head + "\n SG_ X " + definition + " NODE\n" + behind, "car.dbc");
  EXPECT_TRUE(file) << file.error().message;
  return SignalPlan::make(*file, "X");
}

double value_of(const std::string& definition, std::initializer_list<std::uint8_t> bytes,
                const std::string& behind = "") {
  const auto plan = plan_of(definition, behind);
  EXPECT_TRUE(plan) << plan.error().message;
  const auto value = plan->value(data_frame({291, false}, bytes));
  EXPECT_TRUE(value);
  return value.value_or(NAN);
}

TEST(SignalPlan, ReadsSignalsOfCarsAsCalculatedByHand) {
  // Motorola from bit 1: two bits of the first byte, then all of the second. 0x1FF = 511.
  EXPECT_DOUBLE_EQ(value_of(": 1|10@0+ (0.244,-125) [0|0] \"deg/s\"", {0xFD, 0xFF}),
                   511 * 0.244 - 125);
  // Motorola, bytes 5 and 6. 32500 is standing still.
  EXPECT_NEAR(value_of(": 39|16@0+ (0.0002,-6.5) [0|0] \"rad/s\"", {0, 0, 0, 0, 0x7E, 0xF4}), 0,
              1e-12);
  // Intel, byte 6 and five bits of byte 7: 0x0FFF = 4095.
  EXPECT_NEAR(value_of(": 40|13@1+ (0.01,-40.95) [0|0] \"deg/s\"", {0, 0, 0, 0, 0, 0xFF, 0xEF}), 0,
              1e-12);
  // Intel, 14 bits and a sign bit of its own.
  EXPECT_DOUBLE_EQ(value_of(": 40|14@1+ (0.01,0) [0|0] \"\"", {0, 0, 0, 0, 0, 0x39, 0x70, 0}),
                   0x3039 * 0.01);
  EXPECT_DOUBLE_EQ(value_of(": 54|1@1+ (1,0) [0|0] \"\"", {0, 0, 0, 0, 0, 0x39, 0x70, 0}), 1);
  // Motorola, 15 bits from bit 6: the top bit of the first byte is another signal's. 0x2710 =
  // 10000.
  EXPECT_NEAR(value_of(": 6|15@0+ (0.01,-67.67) [0|250] \"km/h\"", {0xA7, 0x10}), 32.33, 1e-9);
}

TEST(SignalPlan, ReadsNegativeNumbers) {
  EXPECT_EQ(value_of(": 0|8@1- (1,0) [0|0] \"\"", {0xFF}), -1);
  EXPECT_EQ(value_of(": 0|8@1- (1,0) [0|0] \"\"", {0x80}), -128);
  EXPECT_EQ(value_of(": 4|4@1- (1,0) [0|0] \"\"", {0x70}), 7);
  EXPECT_EQ(value_of(": 7|16@0- (1,0) [0|0] \"\"", {0xFF, 0xFE}), -2);
  EXPECT_EQ(value_of(": 0|1@1- (1,0) [0|0] \"\"", {0x01}), -1);
  EXPECT_EQ(value_of(": 0|64@1- (1,0) [0|0] \"\"", {0, 0, 0, 0, 0, 0, 0, 0x80}), -std::pow(2, 63));
}

TEST(SignalPlan, ReadsFloatingPointNumbers) {
  const std::string type_1 = "SIG_VALTYPE_ 291 X : 1;\n", type_2 = "SIG_VALTYPE_ 291 X 2;\n";
  EXPECT_EQ(value_of(": 0|32@1- (2,1) [0|0] \"\"", {0, 0, 0x20, 0xC1}, type_1), 2 * -10.0 + 1);
  EXPECT_EQ(value_of(": 7|32@0- (1,0) [0|0] \"\"", {0xC1, 0x20, 0, 0}, type_1), -10);
  EXPECT_EQ(value_of(": 0|64@1- (1,0) [0|0] \"\"", {0, 0, 0, 0, 0, 0, 0x24, 0xC0}, type_2), -10);
  EXPECT_TRUE(std::isnan(value_of(": 0|32@1- (1,0) [0|0] \"\"", {0xFF, 0xFF, 0xFF, 0xFF}, type_1)));
}

TEST(SignalPlan, GivesTheSameAsGoingBitByBit) {
  std::mt19937 random(2026);
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    const int length = std::array{1, 2, 8, 8, 12, 64}[static_cast<std::size_t>(random() % 6)];
    DbcFile file;
    file.messages.push_back(random_message(random, 0x80000000U | i, length, 1));
    const auto plan = SignalPlan::make(file, "S0");
    ASSERT_TRUE(plan) << plan.error().message;
    CanFrame frame;
    frame.id = plan->id();
    frame.length = static_cast<std::uint8_t>(length);
    frame.fd = length > 8;
    for (int byte = 0; byte < length; ++byte) {
      frame.data[static_cast<std::size_t>(byte)] = static_cast<std::uint8_t>(random());
    }
    const auto value = plan->value(frame);
    ASSERT_TRUE(value);
    ASSERT_EQ(*value, slow_value(file.messages[0].signals[0], frame.payload()))
        << dbc_text(file) << candump_line(frame, "can0");
    // And nothing of a frame without data.
    frame.length = 0;
    EXPECT_FALSE(plan->value(frame));
  }
}

TEST(SignalPlan, HasNoValueWhereTheFrameIsTooShort) {
  const auto plan = plan_of(": 8|16@1+ (1,0) [0|0] \"\"");
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan->value(data_frame({291, false}, {1, 2})));
  EXPECT_EQ(plan->value(data_frame({291, false}, {1, 2, 3})), 0x0302);
  CanFrame remote = data_frame({291, false}, {1, 2, 3});
  remote.remote = true;
  EXPECT_FALSE(plan->value(remote));
}

TEST(SignalPlan, KnowsBothFormatsOfIds) {
  const std::string definition = ": 0|8@1+ (1,0) [0|0] \"\"";
  EXPECT_EQ(plan_of(definition)->id(), (CanId{291, false}));
  EXPECT_EQ(plan_of(definition, "", "BO_ 2566844672 M: 8 NODE")->id(), (CanId{0x18FEF100, true}));
  const auto neither = plan_of(definition, "", "BO_ 4096 M: 8 NODE");
  ASSERT_FALSE(neither);
  EXPECT_EQ(neither.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(neither.error().message, HasSubstr("car.dbc:1: signal M.X is in a message numbered"));
}

TEST(SignalPlan, RefusesSignalsThatOnlySomeFramesHold) {
  const auto selected = plan_of("m3 : 0|8@1+ (1,0) [0|0] \"\"");
  ASSERT_FALSE(selected);
  EXPECT_EQ(selected.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(selected.error().message, HasSubstr("car.dbc:2: signal M.X is multiplexed"));
  EXPECT_FALSE(plan_of("m3M : 0|8@1+ (1,0) [0|0] \"\""));
  EXPECT_TRUE(plan_of("M : 0|8@1+ (1,0) [0|0] \"\"")) << "the selector is always there";
}

TEST(SignalPlan, RefusesSignalsThatDoNotFit) {
  const auto complaint = [](const std::string& definition, const std::string& behind = "") {
    const auto plan = plan_of(definition, behind);
    EXPECT_FALSE(plan) << definition;
    if (plan) return std::string();
    EXPECT_EQ(plan.error().code, ErrorCode::kMalformed);
    return plan.error().message;
  };
  EXPECT_THAT(complaint(": 57|8@1+ (1,0) [0|0] \"\""), HasSubstr("does not fit"));
  EXPECT_THAT(complaint(": 62|8@0+ (1,0) [0|0] \"\""), HasSubstr("does not fit"));
  EXPECT_THAT(complaint(": 64|1@1+ (1,0) [0|0] \"\""), HasSubstr("does not fit"));
  EXPECT_THAT(complaint(": -1|1@1+ (1,0) [0|0] \"\""), HasSubstr("does not fit"));
  EXPECT_THAT(complaint(": 2147483647|64@0+ (1,0) [0|0] \"\""), HasSubstr("from bit 2147483647"));
  EXPECT_THAT(complaint(": 0|0@1+ (1,0) [0|0] \"\""), HasSubstr("1 to 64"));
  EXPECT_THAT(complaint(": 0|65@1+ (1,0) [0|0] \"\""), HasSubstr("1 to 64"));
  EXPECT_THAT(complaint(": 0|16@1+ (1,0) [0|0] \"\"", "SIG_VALTYPE_ 291 X : 1;\n"),
              HasSubstr("floating-point number of 16 bits; expected 32"));
}

}  // namespace
}  // namespace terracut::test
