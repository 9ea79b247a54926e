// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/robosense/unit_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "calib/beams/angle.hpp"
#include "terracut/calibration.hpp"
#include "tests/calib/calib_test_support.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::robosense {
namespace {

using sensor::SensorModel;
using testing::HasSubstr;
using testing::StartsWith;

constexpr SensorModel kModels[] = {SensorModel::kRs32, SensorModel::kHelios};

std::string text_of(SensorModel model) {
  return unit_csv_text(beams::built_in_table(model));
}
std::string message_of(const std::string& text, std::optional<SensorModel> wanted = {}) {
  const auto read = parse_unit_csv(text, "angle.csv", wanted);
  return read ? "read" : read.error().message;
}

TEST(RoboSenseUnitTable, ATableWrittenIsReadBackForTheSameModel) {
  const test::ScratchFolder folder;
  for (const SensorModel model : kModels) {
    const beams::BeamTable table = beams::built_in_table(model);
    ASSERT_TRUE(write_unit_csv(folder / "angle.csv", table));
    for (const auto& read :
         {read_unit_csv(folder / "angle.csv"), read_unit_csv(folder / "angle.csv", model)}) {
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read->model, model);
      EXPECT_EQ(read->origin, (folder / "angle.csv").string());
      EXPECT_EQ(fingerprint(*read), fingerprint(table));
    }
    const auto loaded = Calibration::load(folder / "angle.csv");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->sensor(), sensor::sensor_of(model));
  }
}

TEST(RoboSenseUnitTable, ASpoiltTableOf32LinesIsExplainedAsOne) {
  const test::ScratchFolder folder;
  std::string text = text_of(SensorModel::kHelios);
  text.insert(text.find('\n') + 1, "up");
  calib::write_text(folder / "angle.csv", text);
  const auto loaded = Calibration::load(folder / "angle.csv");
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, HasSubstr("angle.csv:2: "));
  EXPECT_THAT(loaded.error().message, HasSubstr("RS-LiDAR-32 or RS-Helios"));
}

TEST(RoboSenseUnitTable, TheFileOfTheMakersDriverIsAnRs32s) {
  const auto path = test::shared_data("calib/rs32-angle.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto read = read_unit_csv(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->model, SensorModel::kRs32);
  EXPECT_EQ(fingerprint(*read), fingerprint(beams::built_in_table(SensorModel::kRs32)));
}

TEST(RoboSenseUnitTable, AnotherModelsTableIsRefusedForAnRs32InWhicheverOrderItsChannelsAre) {
  EXPECT_THAT(message_of(text_of(SensorModel::kHelios), SensorModel::kRs32),
              HasSubstr("not those of a RoboSense RS-LiDAR-32"));
  EXPECT_EQ(message_of(text_of(SensorModel::kHelios), SensorModel::kHelios), "read");
  std::string turned;
  for (std::string rest = text_of(SensorModel::kRs32); !rest.empty();) {
    const std::size_t end = rest.find('\n') + 1;
    turned.insert(0, rest.substr(0, end));
    rest.erase(0, end);
  }
  EXPECT_EQ(message_of(turned, SensorModel::kRs32), "read");
}

TEST(RoboSenseUnitTable, WhatIsNoTableIsRefusedByLineOrChannel) {
  const std::string good = text_of(SensorModel::kHelios);
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    return text.replace(text.find(before), before.size(), after);
  };
  EXPECT_THAT(message_of(with("13.000,", "13.000;")), StartsWith("angle.csv:2: "));
  EXPECT_THAT(message_of(good + "1,1\n"), HasSubstr("has 33 lines, expected 32"));
  EXPECT_THAT(message_of(with("13.000,", "91,")), HasSubstr("channel 2 of 32: elevation 91.000"));
  EXPECT_THAT(message_of(with("13.000,0.000", "13,-30.001")), HasSubstr("channel 2 of 32"));
  std::string level;
  for (int channel = 0; channel < 32; ++channel) level += "1,0\n";
  EXPECT_EQ(message_of(level), "angle.csv: all 32 elevations are the same");
  EXPECT_THAT(message_of(std::string()), HasSubstr("is empty"));
}

TEST(RoboSenseUnitTable, AFileThatIsNotThereOrATableOfAnotherSizeIsAnError) {
  EXPECT_EQ(read_unit_csv("/nowhere/angle.csv").error().code, ErrorCode::kNotFound);
  beams::BeamTable table = beams::built_in_table(SensorModel::kRs32);
  table.lasers.pop_back();
  EXPECT_EQ(write_unit_csv("/nowhere/angle.csv", table).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace terracut::robosense
