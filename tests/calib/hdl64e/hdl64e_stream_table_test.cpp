// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_stream_table.hpp"

#include <random>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::hdl64e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::array<std::uint8_t, kStreamTableBytes> nominal_table(
    StreamTableCheck check = StreamTableCheck::kCrc) {
  const auto made = make_stream_table(nominal_hdl64e(), ReturnSetting::kLast, check);
  EXPECT_TRUE(made.has_value());
  return made.value();
}

TEST(StreamTable, ParsesExactlyWhatWasMade) {
  for (const StreamTableCheck check : {StreamTableCheck::kCrc, StreamTableCheck::kLengthMarker}) {
    const auto parsed = parse_stream_table(nominal_table(check));
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_EQ(parsed->lasers, nominal_hdl64e().lasers);
    EXPECT_EQ(parsed->origin, "packet stream");
    EXPECT_EQ(fingerprint(*parsed), fingerprint(nominal_hdl64e()));
  }
}

TEST(StreamTable, PutsTheManualsExampleBytesInTheirPlaces) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  calibration.lasers[2].vert_correction_rad = beams::deg_to_rad(-8.79);  // 91 FC
  calibration.lasers[2].dist_correction_m = 1.228;                       // CC 04
  calibration.lasers[2].dist_correction_x_m = 1.25;
  calibration.lasers[2].dist_correction_y_m = 1.24;
  const auto made = make_stream_table(calibration, ReturnSetting::kLast);
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const auto& bytes = *made;
  const std::size_t laser = 7 + 28 * 2;
  EXPECT_EQ(bytes[laser], 2);
  EXPECT_EQ(bytes[laser + 1], 0x91);
  EXPECT_EQ(bytes[laser + 2], 0xFC);
  EXPECT_EQ(bytes[laser + 5], 0xCC);
  EXPECT_EQ(bytes[laser + 6], 0x04);
  EXPECT_EQ(bytes[256 * 7], 0xFF);  // year of the calibration: there is none
  EXPECT_EQ(bytes[256 * 7 + 5], 0xFF);
  EXPECT_EQ(bytes[259 * 7 + 2], 1);  // return setting
  EXPECT_EQ(bytes[1818] | bytes[1819] << 8, stream_table_crc(bytes));
}

TEST(StreamTable, CrcIsThePlainCrc16OfItsPolynomial) {
  // Bit-serial long division by x^16 + x^15 + x^2 + 1, written without looking at bytes.
  const auto bytes = nominal_table();
  std::uint32_t remainder = 0;
  const auto shift_in = [&](int bit) {
    remainder = (remainder << 1) | static_cast<std::uint32_t>(bit);
    if ((remainder & 0x10000U) != 0) remainder ^= 0x18005U;
  };
  for (int laser = 0; laser < 64; ++laser) {
    for (int k = 0; k < 20; ++k) {
      const auto byte = bytes[static_cast<std::size_t>(8 + 28 * laser + k)];
      for (int bit = 7; bit >= 0; --bit) shift_in((byte >> bit) & 1);
    }
  }
  for (int bit = 0; bit < 16; ++bit) shift_in(0);
  EXPECT_EQ(stream_table_crc(bytes), remainder);
}

TEST(StreamTable, EveryFlippedBitOfALaserIsCaught) {
  const auto good = nominal_table();
  for (std::size_t byte = 7; byte < 7 + 28; ++byte) {
    if (byte - 7 >= 21) continue;  // the warning and reserved bytes are not under the CRC
    for (int bit = 0; bit < 8; ++bit) {
      auto bad = good;
      bad[byte] = static_cast<std::uint8_t>(bad[byte] ^ (1U << bit));
      EXPECT_FALSE(parse_stream_table(bad).has_value()) << byte << "." << bit;
    }
  }
}

TEST(StreamTable, SaysWhatIsWrong) {
  auto bytes = nominal_table();
  bytes[4] = 'X';
  EXPECT_THAT(parse_stream_table(bytes),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("UNIT#")));
  bytes = nominal_table();
  bytes[1818] ^= 1;
  EXPECT_THAT(parse_stream_table(bytes),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("CRC")));
  bytes = nominal_table();
  bytes[7 + 28 * 5] = 6;
  EXPECT_THAT(parse_stream_table(bytes),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   HasSubstr("laser number 6 in the place of laser 5")));
  bytes = nominal_table(StreamTableCheck::kLengthMarker);
  bytes[7 + 28 * 5 + 2] = 0x70;  // vertical correction of about +287 deg
  EXPECT_THAT(parse_stream_table(bytes),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("packet stream"), HasSubstr("laser 5"),
                                         HasSubstr("vertical correction"))));
}

TEST(StreamTable, RefusesToMakeWhatDoesNotFit) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  calibration.lasers[0].focal_distance_m = 40;  // 16 bit of millimetres end at 32.767 m
  EXPECT_THAT(make_stream_table(calibration),
              calib::IsRefusedWith(ErrorCode::kInvalidArgument, HasSubstr("focal distance")));
}

TEST(StreamTable, LasersWithoutTwoPointStayWithout) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  for (Hdl64eLaser& laser : calibration.lasers) laser.two_point = false;
  const auto made = make_stream_table(calibration);
  ASSERT_TRUE(made.has_value());
  const auto parsed = parse_stream_table(*made);
  ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
  for (const Hdl64eLaser& laser : parsed->lasers) EXPECT_FALSE(laser.two_point);
  EXPECT_EQ(fingerprint(*parsed), fingerprint(calibration));
}

TEST(StreamTable, RandomBytesAreNeverATable) {
  std::mt19937 random(5);
  std::array<std::uint8_t, kStreamTableBytes> bytes{};
  for (int i = 0; i < 200; ++i) {
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_FALSE(parse_stream_table(bytes).has_value());
    std::copy_n("UNIT#", 5, bytes.begin());
    EXPECT_FALSE(parse_stream_table(bytes).has_value());
  }
}

TEST(StreamTable, ARealUnitKeepsItsFingerprintThroughTheStream) {
  for (const char* name : {"64e_s2.1-sztaki.xml", "db-ajaayc.xml", "HDL-64E_S3-VeloView.yml"}) {
    const auto path = test::shared_data(std::string("calib/") + name);
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const auto unit = load_hdl64e_calibration(path);
    ASSERT_TRUE(unit.has_value());
    const auto made = make_stream_table(*unit);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const auto parsed = parse_stream_table(*made);
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_EQ(fingerprint(*parsed), fingerprint(*unit)) << name;
  }
}

}  // namespace
}  // namespace terracut::hdl64e
