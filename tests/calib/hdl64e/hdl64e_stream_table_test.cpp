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

UnitInfo some_unit() {
  UnitInfo unit;
  unit.calibration_date = {2017, 2, 15, 13, 59, 7};
  unit.humidity_percent = 41;
  unit.upper_noise_threshold = 12;
  unit.lower_noise_threshold = 34;
  unit.motor_rpm = 600;
  unit.fov_start_cdeg = 0;
  unit.fov_end_cdeg = 36000;
  unit.hours_run = 0x1234;
  unit.source_ip = {192, 168, 3, 43};
  unit.destination_ip = {192, 168, 3, 255};
  unit.return_setting = static_cast<std::uint8_t>(ReturnSetting::kLast);
  unit.power_level = 0xA8;
  unit.warning_bits = 0x60;
  return unit;
}

std::array<std::uint8_t, kStreamTableBytes> nominal_table(
    StreamTableCheck check = StreamTableCheck::kCrc) {
  const auto made = make_stream_table(nominal_hdl64e(), some_unit(), check);
  EXPECT_TRUE(made.has_value());
  return made.value();
}

TEST(StreamTable, ParsesExactlyWhatWasMade) {
  for (const StreamTableCheck check : {StreamTableCheck::kCrc, StreamTableCheck::kLengthMarker}) {
    const auto parsed = parse_stream_table(nominal_table(check));
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_EQ(parsed->calibration.lasers, nominal_hdl64e().lasers);
    EXPECT_EQ(parsed->calibration.origin, "packet stream");
    EXPECT_EQ(parsed->unit, some_unit());
    EXPECT_EQ(parsed->check, check);
    EXPECT_EQ(fingerprint(parsed->calibration), fingerprint(nominal_hdl64e()));
  }
}

TEST(StreamTable, PutsTheManualsExampleBytesInTheirPlaces) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  calibration.lasers[2].vert_correction_rad = beams::deg_to_rad(-8.79);  // 91 FC
  calibration.lasers[2].dist_correction_m = 1.228;                       // CC 04
  calibration.lasers[2].dist_correction_x_m = 1.25;
  calibration.lasers[2].dist_correction_y_m = 1.24;
  const auto made = make_stream_table(calibration, some_unit());
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const auto& bytes = *made;
  const std::size_t laser = 7 + 28 * 2;
  EXPECT_EQ(bytes[laser], 2);
  EXPECT_EQ(bytes[laser + 1], 0x91);
  EXPECT_EQ(bytes[laser + 2], 0xFC);
  EXPECT_EQ(bytes[laser + 5], 0xCC);
  EXPECT_EQ(bytes[laser + 6], 0x04);
  EXPECT_EQ(bytes[laser + 21], 0x60);  // warning byte of group 4 + 4 i
  EXPECT_EQ(bytes[256 * 7], 17);       // year
  EXPECT_EQ(bytes[256 * 7 + 6], 41);   // humidity
  EXPECT_EQ(bytes[257 * 7], 0x58);     // 600 rpm
  EXPECT_EQ(bytes[257 * 7 + 1], 0x02);
  EXPECT_EQ(bytes[257 * 7 + 6], 0x34);  // hours, low
  EXPECT_EQ(bytes[258 * 7], 0x12);      // hours, high
  EXPECT_EQ(bytes[258 * 7 + 1], 192);
  EXPECT_EQ(bytes[259 * 7 + 1], 255);
  EXPECT_EQ(bytes[259 * 7 + 2], 1);
  EXPECT_EQ(bytes[259 * 7 + 4], 0xA8);
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

TEST(StreamTable, AnUnsetCalibrationDateIsAbsent) {
  UnitInfo unit = some_unit();
  unit.calibration_date.reset();
  auto made = make_stream_table(nominal_hdl64e(), unit);
  ASSERT_TRUE(made.has_value());
  EXPECT_EQ((*made)[256 * 7], 0xFF);
  EXPECT_FALSE(parse_stream_table(*made)->unit.calibration_date.has_value());
  std::fill_n(made->begin() + 256 * 7, 6, std::uint8_t{0});
  EXPECT_FALSE(parse_stream_table(*made)->unit.calibration_date.has_value());
}

TEST(StreamTable, RefusesToMakeWhatDoesNotFit) {
  UnitInfo unit = some_unit();
  unit.motor_rpm = 40000;
  EXPECT_THAT(make_stream_table(nominal_hdl64e(), unit),
              calib::IsRefusedWith(ErrorCode::kInvalidArgument, HasSubstr("motor speed is 40000")));
  Hdl64eCalibration calibration = nominal_hdl64e();
  calibration.lasers[0].focal_distance_m = 40;  // 16 bit of millimetres end at 32.767 m
  EXPECT_THAT(make_stream_table(calibration, some_unit()),
              calib::IsRefusedWith(ErrorCode::kInvalidArgument, HasSubstr("focal distance")));
}

TEST(StreamTable, LasersWithoutTwoPointStayWithout) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  for (Hdl64eLaser& laser : calibration.lasers) laser.two_point = false;
  const auto made = make_stream_table(calibration, some_unit());
  ASSERT_TRUE(made.has_value());
  const auto parsed = parse_stream_table(*made);
  ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
  for (const Hdl64eLaser& laser : parsed->calibration.lasers) EXPECT_FALSE(laser.two_point);
  EXPECT_EQ(fingerprint(parsed->calibration), fingerprint(calibration));
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
    const auto made = make_stream_table(*unit, some_unit());
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const auto parsed = parse_stream_table(*made);
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_EQ(fingerprint(parsed->calibration), fingerprint(*unit)) << name;
  }
}

}  // namespace
}  // namespace terracut::hdl64e
