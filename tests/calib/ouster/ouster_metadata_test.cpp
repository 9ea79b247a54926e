// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ouster/ouster_metadata.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "calib/beams/angle.hpp"
#include "calib/ouster/ouster_product.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::ouster {
namespace {

/// A unit's metadata in the old form, with one piece of it replaced.
std::string bent(const std::string& piece, const std::string& by) {
  std::string text = ouster_metadata_text(nominal_ouster(sensor::SensorModel::kOuster32));
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return text.replace(at, piece.size(), by);
}

std::string refusal(const std::string& text) {
  const auto parsed = parse_ouster_metadata(text, "meta.json");
  EXPECT_FALSE(parsed.has_value());
  return parsed ? "" : parsed.error().message;
}

TEST(OusterMetadata, IsWrittenAndReadWithoutLoss) {
  for (const auto model : {sensor::SensorModel::kOuster32, sensor::SensorModel::kOuster64,
                           sensor::SensorModel::kOuster128}) {
    OusterCalibration unit = nominal_ouster(model);
    unit.product = "OS-1-TEST";
    unit.format.profile = Profile::kLowRateDual;
    unit.columns_per_frame = 2048;
    unit.window = {256, 1791};
    const std::string text = ouster_metadata_text(unit);
    const auto again = parse_ouster_metadata(text, "meta.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(fingerprint(*again), fingerprint(unit));
    EXPECT_EQ(again->format, unit.format);
    EXPECT_EQ(again->window, unit.window);
    EXPECT_EQ(again->rate_hz, 10);
    EXPECT_EQ(again->product, "OS-1-TEST");
    EXPECT_EQ(ouster_metadata_text(*again), text);
  }
}

TEST(OusterMetadata, MayStandInMapsByTopic) {
  const std::string nested =
      R"({
    "beam_intrinsics": {
      "beam_altitude_angles": [)" +
      std::string("20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, ") +
      R"(4, 3, 2, 1, 0, -1, -2, -3, -4, -5, -6, -7, -8, -9, -10, -11],
      "beam_azimuth_angles": [)" +
      std::string("4, 1, -1, -4, 4, 1, -1, -4, 4, 1, -1, -4, 4, 1, -1, -4, ") +
      R"(4, 1, -1, -4, 4, 1, -1, -4, 4, 1, -1, -4, 4, 1, -1, -4],
      "beam_to_lidar_transform": [1, 0, 0, 12, 0, 1, 0, 0, 0, 0, 1, 5, 0, 0, 0, 1],
      "lidar_origin_to_beam_origin_mm": 13},
    "config_params": {"lidar_mode": "512x20", "udp_profile_lidar": "RNG15_RFL8_NIR8"},
    "lidar_data_format": {"columns_per_frame": 512, "columns_per_packet": 16,
      "column_window": [128, 383], "pixels_per_column": 32, "udp_profile_lidar": "RNG15_RFL8_NIR8"},
    "lidar_intrinsics": {
      "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 38.195, 0, 0, 0, 1]},
    "sensor_info": {"prod_line": "OS-1-32"}})";
  const auto unit = parse_ouster_metadata(nested, "meta.json");
  ASSERT_TRUE(unit) << unit.error().message;
  EXPECT_EQ(unit->format, (PacketFormat{.profile = Profile::kLowRate, .rows = 32, .columns = 16}));
  EXPECT_EQ(unit->columns_per_frame, 512);
  EXPECT_EQ(unit->rate_hz, 20);
  EXPECT_EQ(unit->window, (std::array{128, 383}));
  EXPECT_DOUBLE_EQ(unit->ahead_m, 0.012);
  EXPECT_DOUBLE_EQ(unit->beam_origin_m, 0.013);
  EXPECT_DOUBLE_EQ(unit->lasers[3].vert_offset_m, 0.005);
  EXPECT_DOUBLE_EQ(unit->T_sensor_lidar[11], 0.038195);
  EXPECT_DOUBLE_EQ(beams::rad_to_deg(unit->lasers[31].elevation_rad), -11);
  EXPECT_EQ(unit->product, "OS-1-32");
  EXPECT_EQ(unit->origin, "meta.json");
}

TEST(OusterMetadata, TakesWhatOldFirmwareLeavesOutAndSaysSo) {
  std::string text = "{\"lidar_mode\": \"1024x10\", \"beam_altitude_angles\": [";
  for (int row = 0; row < 32; ++row) text += (row > 0 ? "," : "") + std::to_string(16 - row);
  text += "], \"beam_azimuth_angles\": [";
  for (int row = 0; row < 32; ++row) text += row > 0 ? ",0" : "0";
  text += "]}";
  const auto unit = parse_ouster_metadata(text, "meta.json");
  ASSERT_TRUE(unit) << unit.error().message;
  EXPECT_EQ(unit->format.profile, Profile::kLegacy);
  EXPECT_EQ(unit->format.columns, 16);
  EXPECT_DOUBLE_EQ(unit->beam_origin_m, 0.015806);
  EXPECT_DOUBLE_EQ(unit->T_sensor_lidar[0], -1);
  EXPECT_DOUBLE_EQ(unit->T_sensor_lidar[11], 0.03618);
  EXPECT_NE(unit->origin.find("lidar_origin_to_beam_origin_mm"), std::string::npos) << unit->origin;
  EXPECT_NE(unit->origin.find("lidar_to_sensor_transform"), std::string::npos) << unit->origin;
}

TEST(OusterMetadata, NamesWhatIsWrongWithIt) {
  EXPECT_NE(refusal("").find("meta.json"), std::string::npos);
  EXPECT_NE(refusal("[1, 2]").find("metadata of an Ouster"), std::string::npos);
  EXPECT_NE(refusal("{\"lidar_mode\": \"1024x10\"}").find("beam_altitude_angles"),
            std::string::npos);
  EXPECT_NE(refusal(bent("\"lidar_mode\": \"1024x10\"", "\"other\": 1")).find("lidar_mode"),
            std::string::npos);
  EXPECT_NE(refusal(bent("1024x10", "fast")).find("'fast'"), std::string::npos);
  EXPECT_NE(
      refusal(bent("\"columns_per_frame\": 1024", "\"columns_per_frame\": 1000")).find("no mode"),
      std::string::npos);
  EXPECT_NE(refusal(bent("RNG19_RFL8_SIG16_NIR16", "RNG99")).find("RNG99"), std::string::npos);
  EXPECT_NE(refusal(bent("\"pixels_per_column\": 32", "\"pixels_per_column\": 64"))
                .find("32 beams for 64 rows"),
            std::string::npos);
  EXPECT_NE(refusal(bent("[22.5, ", "[22.5, 22.4, "))
                .find("33 beam_altitude_angles and 32 beam_azimuth_angles"),
            std::string::npos);
  EXPECT_NE(refusal(bent("[22.5, ", "[90.5, ")).find("beam 1"), std::string::npos);
  EXPECT_NE(refusal(bent("[22.5, ", "[null, ")).find("beam_altitude_angles"), std::string::npos);
  EXPECT_NE(refusal(bent("\"lidar_to_sensor_transform\": [-1", "\"lidar_to_sensor_transform\": [1"))
                .find("no rotation"),
            std::string::npos);
  EXPECT_NE(refusal(bent("\"column_window\": [0, 1023]", "\"column_window\": [0, 1024]"))
                .find("column 1024"),
            std::string::npos);
  EXPECT_NE(
      refusal(bent("\"columns_per_packet\": 16", "\"columns_per_packet\": 15")).find("15 columns"),
      std::string::npos);
}

TEST(OusterMetadata, OfOtherRowsThanWantedIsRefusedByName) {
  const test::ScratchFolder folder;
  const auto path = folder / "meta.json";
  ASSERT_TRUE(write_ouster_metadata(path, nominal_ouster(sensor::SensorModel::kOuster64)));
  EXPECT_TRUE(read_ouster_metadata(path));
  const auto other = read_ouster_metadata(path, sensor::SensorModel::kOuster128);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("64-row Ouster, not of a 128-row Ouster"), std::string::npos)
      << other.error().message;
}

TEST(OusterMetadata, OfRealUnitsIsRead) {
  const std::filesystem::path folder = test::shared_data("ouster");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  struct Unit {
    const char* file;
    int rows;
    Profile profile;
    double origin_m;
  };
  for (const Unit& wanted :
       {Unit{"OS-0-128-U1_v2.3.0_1024x10", 128, Profile::kLowRate, 0.02767},
        Unit{"OS-1-128_767798045_1024x10_20230712_120049", 128, Profile::kLowRateDual, 0.016721},
        Unit{"OS-1-128_v2.3.0_1024x10", 128, Profile::kLowRate, 0.015806},
        Unit{"OS-1-64_sensor_config_reduced", 64, Profile::kLegacy, 0.015806},
        Unit{"OS-2-128-U1_v2.3.0_1024x10", 128, Profile::kSingle, 0.013762}}) {
    const auto unit = read_ouster_metadata(folder / (std::string(wanted.file) + ".json"));
    ASSERT_TRUE(unit) << unit.error().message;
    EXPECT_EQ(unit->format.rows, wanted.rows);
    EXPECT_EQ(unit->format.profile, wanted.profile);
    EXPECT_NEAR(unit->beam_origin_m, wanted.origin_m, 1e-9);
    EXPECT_EQ(unit->columns_per_frame, 1024);
    EXPECT_EQ(unit->rate_hz, 10);
  }
}

TEST(OusterProduct, HasBeamsFromItsHighestToAsFarBelow) {
  for (const auto& [product, highest_deg] :
       {std::pair(Product::kOs0, 45.0), {Product::kOs1, 22.5}, {Product::kOs2, 11.25}}) {
    const OusterCalibration unit = nominal_product(product, sensor::SensorModel::kOuster64);
    ASSERT_EQ(unit.lasers.size(), 64U);
    EXPECT_NEAR(beams::rad_to_deg(unit.lasers.front().elevation_rad), highest_deg, 1e-9);
    EXPECT_NEAR(beams::rad_to_deg(unit.lasers.back().elevation_rad), -highest_deg, 1e-9);
  }
}

}  // namespace
}  // namespace terracut::ouster
