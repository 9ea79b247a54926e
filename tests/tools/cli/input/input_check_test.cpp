// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/input/input_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "calib/hdl64e/hdl64e_xml.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/tables/hdl64e_xml_writer.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InputCheck : public test::InScratchFolder {
 protected:
  [[nodiscard]] static std::string refusal_of(const Options& options) {
    const Status ready = check_inputs(options);
    return ready ? "" : ready.error().message;
  }
  [[nodiscard]] Options with_calibration(const fs::path& file,
                                         std::optional<sensor::SensorModel> sensor = {}) const {
    Options options;
    options.capture.calibration = folder_ / file;
    options.capture.sensor = sensor;
    return options;
  }
};

TEST_F(InputCheck, NamesAFileThatIsNotThere) {
  EXPECT_THAT(refusal_of(with_calibration("nothere.xml")), HasSubstr("nothere.xml"));
  EXPECT_THAT(refusal_of(with_calibration("nothere.csv")), HasSubstr("nothere.csv"));
  Options options;
  options.mount.setup = folder_ / "nothere.yaml";
  EXPECT_THAT(refusal_of(options), HasSubstr("nothere.yaml"));
  options = {};
  options.motion.dbc = folder_ / "nothere.dbc";
  EXPECT_THAT(refusal_of(options), HasSubstr("nothere.dbc"));
}

TEST_F(InputCheck, TakesTheCalibrationOfEitherSensorUntilOneIsNamed) {
  ASSERT_TRUE(hdl64e::write_hdl64e_xml(folder_ / "unit.xml", hdl64e::nominal_hdl64e()));
  ASSERT_TRUE(ruby128::write_ruby128_csv(folder_ / "angle.csv", ruby128::nominal_ruby128()));
  EXPECT_EQ(refusal_of(with_calibration("unit.xml")), "");
  EXPECT_EQ(refusal_of(with_calibration("angle.csv")), "");
  EXPECT_EQ(refusal_of(with_calibration("unit.xml", sensor::SensorModel::kHdl64e)), "");
  EXPECT_THAT(refusal_of(with_calibration("angle.csv", sensor::SensorModel::kHdl64e)),
              HasSubstr("angle.csv"));
  EXPECT_THAT(refusal_of(with_calibration("unit.xml", sensor::SensorModel::kRuby128)),
              HasSubstr("unit.xml"));
}

}  // namespace
}  // namespace terracut::cli
