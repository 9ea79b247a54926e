// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/candump_line.hpp"

#include <gmock/gmock.h>

#include <cstddef>
#include <vector>

#include "frames.hpp"

namespace terracut::test {
namespace {

using can::candump_line;
using can::CanFrame;
using can::parse_candump_line;
using testing::HasSubstr;

CanFrame frame_of(std::string_view line) {
  const auto parsed = parse_candump_line(line);
  EXPECT_TRUE(parsed) << line << ": " << parsed.error().what;
  return parsed ? parsed->frame : CanFrame{};
}

std::string fault_of(std::string_view line) {
  const auto parsed = parse_candump_line(line);
  EXPECT_FALSE(parsed) << line;
  if (parsed) return "";
  EXPECT_TRUE(parsed.error().malformed) << line;
  return std::string(parsed.error().what);
}

TEST(CandumpLine, ReadsAClassicFrame) {
  const auto parsed = parse_candump_line("(1700000000.123456) can0 0AA#1A2B3C");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->interface, "can0");
  EXPECT_EQ(parsed->frame,
            data_frame({0x0AA, false}, {0x1A, 0x2B, 0x3C}, 1'700'000'000'123'456'000));
}

TEST(CandumpLine, ReadsEveryKindOfFrame) {
  EXPECT_EQ(frame_of("(0.0) can0 18FEF100#00.11.22"),
            data_frame({0x18FEF100, true}, {0x00, 0x11, 0x22}));
  EXPECT_EQ(frame_of("(0.0) can0 123#"), data_frame({0x123, false}, {}));

  CanFrame remote;
  remote.id = {0x123, false};
  remote.remote = true;
  EXPECT_EQ(frame_of("(0.0) can0 123#R"), remote);
  remote.length = 8;
  EXPECT_EQ(frame_of("(0.0) can0 123#R8"), remote);
  EXPECT_EQ(frame_of("(0.0) can0 123#R8_E"), remote);

  CanFrame error = data_frame({0x40, false}, {0, 0, 0, 0, 0, 0, 0, 0});
  error.error = true;
  EXPECT_EQ(frame_of("(0.0) can0 20000040#0000000000000000"), error);

  CanFrame fd = data_frame({0x123, false}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  EXPECT_EQ(frame_of("(0.0) can0 123##40102030405060708090A0B0C"), fd);
  fd.bit_rate_switch = fd.sender_passive = true;
  EXPECT_EQ(frame_of("(0.0) can0 123##30102030405060708090a0b0c"), fd);
  CanFrame short_fd = data_frame({0x123, false}, {0xAA});
  short_fd.fd = true;
  EXPECT_EQ(frame_of("(0.0) can0 123##0AA"), short_fd);
}

TEST(CandumpLine, ReadsStampsOfOneToNineDecimals) {
  EXPECT_EQ(frame_of("(1.5) can0 123#").stamp_ns, 1'500'000'000);
  EXPECT_EQ(frame_of("(1.000001) can0 123#").stamp_ns, 1'000'001'000);
  EXPECT_EQ(frame_of("(0000000001.000000001) can0 123#").stamp_ns, 1'000'000'001);
  EXPECT_THAT(fault_of("(1.0000000001) can0 123#"), HasSubstr("decimals"));
  EXPECT_THAT(fault_of("(1.) can0 123#"), HasSubstr("decimals"));
  EXPECT_THAT(fault_of("(1) can0 123#"), HasSubstr("decimals"));
  EXPECT_THAT(fault_of("(-1.5) can0 123#"), HasSubstr("decimals"));
  EXPECT_THAT(fault_of("(9223372036.9) can0 123#"), HasSubstr("decimals"));
  EXPECT_THAT(fault_of("(2026-01-01 10:00:00.5) can0 123#"), HasSubstr("parenthesis"));
}

TEST(CandumpLine, TakesADirectionAndMoreSpaceAndTheOtherEndOfLine) {
  EXPECT_EQ(frame_of("(1.5)   can0  123#AA R"), frame_of("(1.5) can0 123#AA"));
  EXPECT_EQ(frame_of("(1.5) can0 123#AA T\r"), frame_of("(1.5) can0 123#AA"));
  EXPECT_EQ(frame_of("(1.5) can0 123#0011223344556677_F").length, 8);
  EXPECT_EQ(frame_of("(1.5) can0 123#0011223344556677_9").length, 8);
}

TEST(CandumpLine, NamesWhatIsWrong) {
  EXPECT_THAT(fault_of("(1.5 can0 123#AA"), HasSubstr("parenthesis"));
  EXPECT_THAT(fault_of("(1.5)"), HasSubstr("'#'"));
  EXPECT_THAT(fault_of("(1.5)  can0  123   [8]  11 22"), HasSubstr("candump -l"));
  EXPECT_THAT(fault_of("(1.5) can0 800#AA"), HasSubstr("7FF"));
  EXPECT_THAT(fault_of("(1.5) can0 12#AA"), HasSubstr("7FF"));
  EXPECT_THAT(fault_of("(1.5) can0 80000123#AA"), HasSubstr("7FF"));
  EXPECT_THAT(fault_of("(1.5) can0 12G#AA"), HasSubstr("7FF"));
  EXPECT_THAT(fault_of("(1.5) can0 123#A"), HasSubstr("8 bytes"));
  EXPECT_THAT(fault_of("(1.5) can0 123#001122334455667788"), HasSubstr("8 bytes"));
  EXPECT_THAT(fault_of("(1.5) can0 123#-1"), HasSubstr("8 bytes"));
  EXPECT_THAT(fault_of("(1.5) can0 123#R9"), HasSubstr("0 to 8"));
  EXPECT_THAT(fault_of("(1.5) can0 123#00_8"), HasSubstr("9 to F"));
  EXPECT_THAT(fault_of("(1.5) can0 123#00_0G"), HasSubstr("9 to F"));
  EXPECT_THAT(fault_of("(1.5) can0 123#00_10"), HasSubstr("9 to F"));
  EXPECT_THAT(fault_of("(1.5) can0 123##"), HasSubstr("flags"));
  EXPECT_THAT(fault_of("(1.5) can0 123##0001122334455667788"), HasSubstr("FD frame"));
  EXPECT_THAT(fault_of("(1.5) can0 20000004##0AA"), HasSubstr("error frame"));
  EXPECT_THAT(fault_of("(1.5) can0 123#AA X"), HasSubstr("R or T"));
  EXPECT_THAT(fault_of("(1.5) can0 123#AA R T"), HasSubstr("R or T"));
}

TEST(CandumpLine, TakesTheLengthsThatAnFdFrameCanHave) {
  std::vector<std::size_t> lengths;
  for (std::size_t bytes = 0; bytes <= 70; ++bytes) {
    if (can::is_fd_length(bytes)) lengths.push_back(bytes);
  }
  EXPECT_THAT(lengths, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64));
}

TEST(CandumpLine, TellsWhatIsNoFrameFromWhatIsMalformed) {
  for (const std::string_view line :
       {"", "  ", "# recorded on Monday", "DROPCOUNT: dropped 5 CAN frames on can0",
        "(1.5) can0 45123#81:00:12345678#11223344"}) {
    const auto parsed = parse_candump_line(line);
    ASSERT_FALSE(parsed) << line;
    EXPECT_FALSE(parsed.error().malformed) << line;
  }
}

TEST(CandumpLine, ReadsWhatItWrites) {
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    const CanFrame frame = random_frame(random);
    const std::string line = candump_line(frame, "vcan1");
    ASSERT_EQ(line.back(), '\n');
    const auto parsed = parse_candump_line(std::string_view(line).substr(0, line.size() - 1));
    ASSERT_TRUE(parsed) << line << parsed.error().what;
    ASSERT_EQ(parsed->frame, frame);
    ASSERT_EQ(parsed->interface, "vcan1");
  }
}

TEST(CandumpLine, WritesMicrosecondsWhereThatIsAllThereIs) {
  const auto frame = data_frame({0x7, false}, {0xAB}, 1'700'000'000'000'001'000);
  EXPECT_EQ(candump_line(frame, "can0"), "(1700000000.000001) can0 007#AB\n");
  EXPECT_EQ(candump_line(data_frame({7, true}, {}, 5), "can0"),
            "(0000000000.000000005) can0 00000007#\n");
}

}  // namespace
}  // namespace terracut::test
