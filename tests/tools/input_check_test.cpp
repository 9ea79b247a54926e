// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/input_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "calib/nominal_hdl64e.hpp"
#include "calib/hdl64e_xml.hpp"
#include "calib/nominal_ruby128.hpp"
#include "calib/ruby128_csv.hpp"
#include "firmware_io/sinks/listening_socket.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InputCheck : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::make_scratch_folder(); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] static std::string refusal_of(const LiveOptions& options) {
    const Status ready = check_before_listening(options);
    return ready ? "" : ready.error().message;
  }
  [[nodiscard]] LiveOptions with_calibration(const fs::path& file,
                                             const std::string& sensor = "auto") const {
    LiveOptions options;
    options.capture.calibration = folder_ / file;
    options.capture.sensor = sensor;
    return options;
  }
  fs::path folder_;
};

TEST_F(InputCheck, NamesAFileThatIsNotThere) {
  EXPECT_THAT(refusal_of(with_calibration("nothere.xml")), HasSubstr("nothere.xml"));
  EXPECT_THAT(refusal_of(with_calibration("nothere.csv")), HasSubstr("nothere.csv"));
  LiveOptions options;
  options.mount.setup = folder_ / "nothere.yaml";
  EXPECT_THAT(refusal_of(options), HasSubstr("nothere.yaml"));
  options = {};
  options.motion.dbc = folder_ / "nothere.dbc";
  EXPECT_THAT(refusal_of(options), HasSubstr("nothere.dbc"));
}

TEST_F(InputCheck, TakesTheCalibrationOfEitherSensorUntilOneIsNamed) {
  ASSERT_TRUE(calib::write_hdl64e_xml(folder_ / "unit.xml", calib::nominal_hdl64e()));
  ASSERT_TRUE(calib::write_ruby128_csv(folder_ / "angle.csv", calib::nominal_ruby128()));
  EXPECT_EQ(refusal_of(with_calibration("unit.xml")), "");
  EXPECT_EQ(refusal_of(with_calibration("angle.csv")), "");
  EXPECT_EQ(refusal_of(with_calibration("unit.xml", "hdl64e")), "");
  EXPECT_THAT(refusal_of(with_calibration("angle.csv", "hdl64e")), HasSubstr("angle.csv"));
  EXPECT_THAT(refusal_of(with_calibration("unit.xml", "ruby128")), HasSubstr("unit.xml"));
}

TEST_F(InputCheck, NamesAStreamAddressThatAnotherProgramHas) {
  LiveOptions options;
  options.stream = (folder_ / "turns").string();
  EXPECT_EQ(refusal_of(options), "");
  const auto taken = firmware_io::ListeningSocket::open({.unix_path = options.stream});
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_THAT(refusal_of(options), HasSubstr("another program listens there"));
}

}  // namespace
}  // namespace terracut::cli
