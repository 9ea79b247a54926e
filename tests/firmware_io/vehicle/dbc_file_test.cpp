// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/dbc_file.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/scratch_folder.hpp"

namespace terracut::test {
namespace {

using testing::HasSubstr;
using vehicle::DbcFile;
using vehicle::DbcMultiplex;
using vehicle::DbcNumber;
using vehicle::find_signal;
using vehicle::parse_dbc;

constexpr std::string_view kCar = R"(VERSION "made up"

NS_ :
	NS_DESC_
	CM_
	BO_TX_BU_
	SIG_VALTYPE_
	SG_MUL_VAL_

BS_:

BU_: ESC XXX

BO_ 180 SPEED: 8 ESC
 SG_ CHECKSUM : 63|8@0+ (1,0) [0|255] "" XXX
 SG_ SPEED : 47|16@0+ (0.01,0) [0|250] "km/h" XXX,ESC

BO_ 2566844672 CCVS: 8 ESC
 SG_ Mode M : 0|2@1+ (1,0) [0|3] "" XXX
 SG_ WheelSpeed m0 : 8|16@1+ (0.00390625,0) [0|250.996] "km/h" XXX
 SG_ Extended m1M : 8|16@1+ (1E-3,-5e1) [-1E+3|1.5E3] "" XXX
 SG_ Plain:24|32@1- ( 1 , -40.5 ) [ 0 | 0 ] "°C"  XXX

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ SPEED : 0|8@1+ (1,0) [0|0] "" Vector__XXX

CM_ SG_ 180 SPEED "a comment of two lines, of which the second is no message:
BO_ 7 NOT_A_MESSAGE: what \"it\" says";
BA_DEF_ BO_  "GenMsgCycleTime" INT 0 0;
VAL_ 180 SPEED 0 "none" 1 "some";
SIG_VALTYPE_ 2566844672 Plain : 1;
)";

DbcFile car() {
  auto file = parse_dbc(kCar, "car.dbc");
  EXPECT_TRUE(file) << file.error().message;
  return file ? *std::move(file) : DbcFile{};
}

TEST(DbcFile, ReadsMessagesAndSignalsAndStepsOverTheRest) {
  const DbcFile file = car();
  ASSERT_EQ(file.messages.size(), 2U);
  const auto& speed = file.messages[0];
  EXPECT_EQ(speed.name, "SPEED");
  EXPECT_EQ(speed.id(), (can::CanId{180, false}));
  EXPECT_EQ(speed.length, 8);
  EXPECT_EQ(speed.line, 14);
  ASSERT_EQ(speed.signals.size(), 2U);
  const auto& signal = speed.signals[1];
  EXPECT_EQ(signal.name, "SPEED");
  EXPECT_EQ(signal.start_bit, 47);
  EXPECT_EQ(signal.bit_count, 16);
  EXPECT_TRUE(signal.motorola);
  EXPECT_EQ(signal.number, DbcNumber::kUnsigned);
  EXPECT_EQ(signal.factor, 0.01);
  EXPECT_EQ(signal.offset, 0);
  EXPECT_EQ(signal.unit, "km/h");
  EXPECT_EQ(signal.line, 16);

  const auto& ccvs = file.messages[1];
  EXPECT_EQ(ccvs.id(), (can::CanId{0x18FEF100, true}));
  ASSERT_EQ(ccvs.signals.size(), 4U);
  EXPECT_EQ(ccvs.signals[0].multiplex, DbcMultiplex::kSelector);
  EXPECT_EQ(ccvs.signals[1].multiplex, DbcMultiplex::kSelected);
  EXPECT_EQ(ccvs.signals[2].multiplex, DbcMultiplex::kSelected);
  EXPECT_EQ(ccvs.signals[2].factor, 1e-3);
  EXPECT_EQ(ccvs.signals[2].offset, -50);
  EXPECT_EQ(ccvs.signals[3].multiplex, DbcMultiplex::kAlways);
  EXPECT_EQ(ccvs.signals[3].number, DbcNumber::kFloat);
  EXPECT_EQ(ccvs.signals[3].offset, -40.5);
}

TEST(DbcFile, FindsSignalsByTheirNameOrTheirMessagesToo) {
  const DbcFile file = car();
  const auto speed = find_signal(file, "SPEED");
  ASSERT_TRUE(speed) << "the one in no message does not count: " << speed.error().message;
  EXPECT_EQ(speed->message->name, "SPEED");
  EXPECT_EQ(find_signal(file, "CCVS.WheelSpeed")->signal->start_bit, 8);

  const auto complaint = [&](std::string_view name) {
    const auto found = find_signal(file, name);
    EXPECT_FALSE(found) << name;
    if (found) return std::string();
    EXPECT_EQ(found.error().code, ErrorCode::kInvalidArgument);
    return found.error().message;
  };
  EXPECT_THAT(complaint("Yaw"), HasSubstr("car.dbc: no signal 'Yaw'"));
  EXPECT_THAT(complaint("CCVS.Yaw"), HasSubstr("no signal 'CCVS.Yaw'"));
  EXPECT_THAT(complaint("ESP.Yaw"), HasSubstr("no message 'ESP'"));
  EXPECT_THAT(complaint(""), HasSubstr("no signal ''"));
}

TEST(DbcFile, AsksWhichOfSeveralSignalsOfOneNameIsMeant) {
  const auto file = parse_dbc(
      "BO_ 1 A: 8 X\n SG_ YAW : 0|8@1+ (1,0) [0|0] \"\" X\n"
      "BO_ 2 B: 8 X\n SG_ YAW : 0|8@1+ (1,0) [0|0] \"\" X\n",
      "car.dbc");
  ASSERT_TRUE(file);
  const auto found = find_signal(*file, "YAW");
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr("A.YAW (line 2), B.YAW (line 4)"));
  EXPECT_EQ(find_signal(*file, "B.YAW")->message->name, "B");
}

TEST(DbcFile, ATextMayHoldAnOddNumberOfQuotationMarksAndEndsOfLineBehindThem) {
  const auto file = parse_dbc(
      "CM_ \"19\\\" wheels\nBO_ 7 NOT_A_MESSAGE: 8 X\";\n"
      "BO_ 1 A: 8 X\n SG_ YAW : 0|8@1+ (1,0) [0|0] \"\" X\n",
      "car.dbc");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->messages.size(), 1U);
  EXPECT_EQ(file->messages[0].name, "A");
  EXPECT_EQ(file->messages[0].line, 3);
}

TEST(DbcFile, NamesTheLineThatIsWrong) {
  const auto complaint = [](std::string_view line) {
    const auto file =
        parse_dbc("VERSION \"\"\r\nCM_ \"two\r\nlines\";\r\nBO_ 1 A: 8 X\r\n" + std::string(line) +
                      "\r\n SG_ B : 0|8@1+ (1,0) [0|0] \"\" X\r\n",
                  "car.dbc");
    EXPECT_FALSE(file) << line;
    if (file) return std::string();
    EXPECT_EQ(file.error().code, ErrorCode::kMalformed);
    return file.error().message;
  };
  for (const std::string_view line : {"BO_ x B: 8 X", "BO_ 4294967296 B: 8 X", "BO_ -1 B: 8 X",
                                      "BO_ 5 B 8 X", "BO_ 5 B: -8 X", "BO_ 5", "BO_"}) {
    EXPECT_THAT(complaint(line), HasSubstr("car.dbc:5: a message has to read")) << line;
  }
  for (const std::string_view line :
       {" SG_", " SG_ S", " SG_ S : 0|8@2+ (1,0) [0|0] \"\" X", " SG_ S : 0|8@1 (1,0) [0|0] \"\" X",
        " SG_ S : 0|8@1+ (1) [0|0] \"\" X", " SG_ S : 0|8@1+ (x,0) [0|0] \"\" X",
        " SG_ S : 0|8@1+ (nan,0) [0|0] \"\" X", " SG_ S : 0|8@1+ (1,1e999) [0|0] \"\" X",
        " SG_ S : 0|8@1+ (1,0) [0] \"\" X", " SG_ S : 0|8@1+ (1,0) [0|0] X",
        " SG_ S : 0|8@1+ (1,0) [0|0] \"km/h X", " SG_ S q : 0|8@1+ (1,0) [0|0] \"\" X",
        " SG_ S mM : 0|8@1+ (1,0) [0|0] \"\" X", " SG_ S : 99999999999|8@1+ (1,0) [0|0] \"\" X"}) {
    EXPECT_THAT(complaint(line), HasSubstr("car.dbc:5: a signal has to read")) << line;
  }
  for (const std::string_view line :
       {"SIG_VALTYPE_ 1 B : 3;", "SIG_VALTYPE_ 1 B : -1;", "SIG_VALTYPE_ 1 B : ;",
        "SIG_VALTYPE_ 1 : 1;", "SIG_VALTYPE_ B : 1;"}) {
    EXPECT_THAT(complaint(line), HasSubstr("car.dbc:5: a value type")) << line;
  }
}

TEST(DbcFile, RefusesWhatIsNoDbcFile) {
  EXPECT_THAT(parse_dbc("", "car.dbc").error().message, HasSubstr("car.dbc: no message in it"));
  EXPECT_THAT(parse_dbc("(1.0) can0 123#00\n", "car.log").error().message,
              HasSubstr("no message in it"));
  EXPECT_THAT(parse_dbc(" SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n", "car.dbc").error().message,
              HasSubstr("car.dbc:1: signal S stands before any message"));

  const ScratchFolder folder;
  EXPECT_EQ(vehicle::read_dbc(folder / "none.dbc").error().code, ErrorCode::kNotFound);
  std::ofstream(folder / "large.dbc") << std::string(5 << 20, '\n');
  EXPECT_EQ(vehicle::read_dbc(folder / "large.dbc").error().code, ErrorCode::kUnsupported);
  std::ofstream(folder / "car.dbc") << kCar;
  EXPECT_TRUE(vehicle::read_dbc(folder / "car.dbc"));
}

}  // namespace
}  // namespace terracut::test
