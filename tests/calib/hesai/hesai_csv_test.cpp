// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hesai/hesai_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "calib/beams/angle.hpp"
#include "terracut/calibration.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::hesai {
namespace {

using sensor::SensorModel;

std::vector<SensorModel> models() {
  std::vector<SensorModel> found;
  for (const sensor::SensorRow& row : sensor::kSensorTable) {
    if (sensor::is_hesai(row.model)) found.push_back(row.model);
  }
  return found;
}

TEST(HesaiCsv, ATableWrittenIsReadBackForTheSameModel) {
  for (const SensorModel model : models()) {
    const beams::BeamTable table = beams::built_in_table(model);
    EXPECT_TRUE(validate(table));
    const auto read = parse_hesai_csv(hesai_csv_text(table), "unit.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->model, model);
    EXPECT_EQ(read->origin, "unit.csv");
    EXPECT_EQ(fingerprint(*read), fingerprint(table));
  }
}

TEST(HesaiCsv, WhatIsNoTableIsRefusedByLine) {
  const std::string good = hesai_csv_text(beams::built_in_table(SensorModel::kPandarXt16));
  const auto message = [](const std::string& text) {
    const auto read = parse_hesai_csv(text, "unit.csv");
    return read ? std::string("read") : read.error().message;
  };
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    return text.replace(text.find(before), before.size(), after);
  };
  EXPECT_EQ(message(good), "read");
  EXPECT_EQ(message(good.substr(good.find('\n') + 1)), "read");  // without names of columns
  EXPECT_TRUE(message(with("3,11.000", "3,eleven")).starts_with("unit.csv:4: \"eleven\" is not"));
  EXPECT_TRUE(message(with("3,11.000", "4,11.000")).starts_with("unit.csv:4: channel \"4\""));
  EXPECT_TRUE(message(with("3,11.000,", "3;11.000;")).starts_with("unit.csv:4: "));
  EXPECT_TRUE(message(with("3,11.000", "3,91")).starts_with("unit.csv:4: elevation beyond"));
  EXPECT_TRUE(message(with("3,11.000", "3,18")).starts_with("unit.csv: has 16 channels"));
  EXPECT_TRUE(message(with("3,11.000,", "3,11.000,,")).find("has not three fields") !=
              std::string::npos);
  EXPECT_TRUE(message("").starts_with("unit.csv: has 0 channels"));
  EXPECT_TRUE(message(good.substr(0, good.size() - 12)).starts_with("unit.csv:"));
}

TEST(HesaiCsv, TheTableOfAnotherModelIsRefusedByName) {
  const test::ScratchFolder folder;
  const auto path = folder / "xt32.csv";
  ASSERT_TRUE(write_hesai_csv(path, beams::built_in_table(SensorModel::kPandarXt32)));
  EXPECT_TRUE(read_hesai_csv(path, SensorModel::kPandarXt32));
  const auto other = read_hesai_csv(path, SensorModel::kPandarXt32m);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(other.error().message.find("Hesai PandarXT-32, not of a Hesai PandarXT-32M"),
            std::string::npos);
  const auto loaded = Calibration::load(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->sensor(), Sensor::kPandarXt32);
}

TEST(HesaiCsv, RealTablesAreThoseOfTheirModels) {
  const auto folder = test::shared_data("hesai");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  for (const auto& [file, model] : {std::pair("Pandar128E4X.csv", SensorModel::kOt128),
                                    {"Pandar40P.csv", SensorModel::kPandar40p},
                                    {"Pandar64.csv", SensorModel::kPandar64},
                                    {"PandarQT64.csv", SensorModel::kPandarQt64},
                                    {"PandarQT128.csv", SensorModel::kPandarQt128},
                                    {"PandarXT16.csv", SensorModel::kPandarXt16},
                                    {"PandarXT32.csv", SensorModel::kPandarXt32},
                                    {"PandarXT32M.csv", SensorModel::kPandarXt32m}}) {
    const auto table = read_hesai_csv(folder / file);
    ASSERT_TRUE(table) << table.error().message;
    EXPECT_EQ(table->model, model);
    const beams::BeamTable nominal = beams::built_in_table(model);
    const double apart_deg = model == SensorModel::kOt128 ? 0.17 : 0.1;
    for (std::size_t i = 0; i < nominal.lasers.size(); ++i) {
      const auto& [unit, usual] = std::pair(table->lasers[i], nominal.lasers[i]);
      EXPECT_NEAR(beams::rad_to_deg(unit.elevation_rad - usual.elevation_rad), 0, apart_deg)
          << file;
      EXPECT_NEAR(beams::rad_to_deg(unit.azimuth_offset_rad - usual.azimuth_offset_rad), 0, 0.22)
          << file;
    }
  }
}

}  // namespace
}  // namespace terracut::hesai
