// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_file.hpp"

#include <algorithm>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/hdl64e_xml.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/calib/calib_test_support.hpp"
#include "tools/lab/tables/hdl64e_xml_writer.hpp"

namespace terracut::hdl64e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What a real file holds, read off it by another program.
struct RealFile {
  const char* name;
  double lowest_deg, highest_deg;
  double least_far_m, most_far_m;
  bool two_point;
};

const RealFile kRealFiles[] = {
    {"64e_s2.1-sztaki.xml", -24.8451, 4.9701, 1.2374, 1.5501, true},
    {"64e_s2.1-sztaki.yaml", -24.8451, 4.9701, 1.2374, 1.5501, true},
    {"64e_s3-xiesc.yaml", -24.5551, 1.9601, 1.3078, 1.5828, true},
    {"64e_utexas.yaml", -24.7110, 2.0208, 0.0100, 0.3200, false},
    {"HDL-64E_S3-VeloView.yml", -23.9500, 2.8100, 1.0870, 1.4420, true},
    {"S3-Unit1090_20170215_db.yaml", -24.5551, 1.9601, 1.3078, 1.5828, true},
    {"angles-calibrated.yaml", -25.5132, 2.0208, 0.0100, 0.3200, false},
    {"angles.yaml", -24.7110, 2.0208, 0.0100, 0.3200, false},
    {"calib-HDL-64E.xml", -24.7903, 2.0208, 0.8000, 1.3900, false},
    {"db-ajaayc.xml", -24.6100, 2.2200, 1.2080, 1.5020, true},
    {"issue_84_float_intensities.yaml", -24.6074, 2.1894, 1.0908, 1.4760, true},
    {"test_db_without_intensities.xml", -25.0665, 1.9250, 0.8600, 1.5798, true},
};

class RealCalibration : public testing::TestWithParam<RealFile> {};

TEST_P(RealCalibration, LoadsWithTheSpansItIsKnownToHave) {
  const RealFile& real = GetParam();
  const auto path = test::shared_data(std::string("calib/") + real.name);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto loaded = load_hdl64e_calibration(path);
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  const auto span_of = [&](double Hdl64eLaser::* field) {
    const auto [low, high] =
        std::minmax_element(loaded->lasers.begin(), loaded->lasers.end(),
                            [&](const auto& a, const auto& b) { return a.*field < b.*field; });
    return std::pair((*low).*field, (*high).*field);
  };
  const auto [lowest, highest] = span_of(&Hdl64eLaser::vert_correction_rad);
  EXPECT_NEAR(beams::rad_to_deg(lowest), real.lowest_deg, 1e-4);
  EXPECT_NEAR(beams::rad_to_deg(highest), real.highest_deg, 1e-4);
  const auto [least, most] = span_of(&Hdl64eLaser::dist_correction_m);
  EXPECT_NEAR(least, real.least_far_m, 1e-4);
  EXPECT_NEAR(most, real.most_far_m, 1e-4);
  EXPECT_EQ(std::any_of(loaded->lasers.begin(), loaded->lasers.end(),
                        [](const auto& laser) { return laser.two_point; }),
            real.two_point);
  EXPECT_EQ(loaded->distance_resolution_m, 0.002);
}

TEST_P(RealCalibration, SurvivesBeingWrittenAsXml) {
  const auto path = test::shared_data(std::string("calib/") + GetParam().name);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto loaded = load_hdl64e_calibration(path);
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_hdl64e_xml(folder / "copy.xml", *loaded));
  const auto copy = load_hdl64e_calibration(folder / "copy.xml");
  ASSERT_TRUE(copy.has_value()) << copy.error().message;
  EXPECT_EQ(fingerprint(*copy), fingerprint(*loaded));
}

std::string test_name(const testing::TestParamInfo<RealFile>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shared, RealCalibration, testing::ValuesIn(kRealFiles), test_name);

TEST(Hdl64eFile, TheSameUnitHasOneFingerprintInXmlAndYaml) {
  const auto xml = test::shared_data("calib/64e_s2.1-sztaki.xml");
  if (!std::filesystem::exists(xml)) GTEST_SKIP() << "no " << xml;
  const auto from_xml = load_hdl64e_calibration(xml);
  const auto from_yaml = load_hdl64e_calibration(test::shared_data("calib/64e_s2.1-sztaki.yaml"));
  ASSERT_TRUE(from_xml && from_yaml);
  // The converter's known flaw put some intensity limits at the wrong laser or left them out.
  Hdl64eCalibration a = *from_xml, b = *from_yaml;
  for (std::size_t i = 0; i < a.lasers.size(); ++i) {
    a.lasers[i].min_intensity = b.lasers[i].min_intensity = 0;
    a.lasers[i].max_intensity = b.lasers[i].max_intensity = 255;
  }
  EXPECT_EQ(fingerprint(a), fingerprint(b));
  const auto block = load_hdl64e_calibration(test::shared_data("calib/64e_s3-xiesc.yaml"));
  const auto inlined =
      load_hdl64e_calibration(test::shared_data("calib/S3-Unit1090_20170215_db.yaml"));
  ASSERT_TRUE(block && inlined);
  EXPECT_EQ(fingerprint(*block), fingerprint(*inlined));
}

TEST(Hdl64eFile, RefusesTheSharedFilesThatAreNoHdl64eTables) {
  const auto folder = test::shared_data("calib");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  EXPECT_THAT(load_hdl64e_calibration(folder / "empty.xml"),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("empty.xml"), HasSubstr("is empty"))));
  EXPECT_THAT(load_hdl64e_calibration(folder / "rs32-angle.csv"),
              calib::IsRefusedWith(ErrorCode::kUnsupported,
                                   AllOf(HasSubstr("rs32-angle.csv"),
                                         HasSubstr("RoboSense angle table"), HasSubstr("db.xml"))));
}

TEST(Hdl64eFile, EverySharedFileIsInOneOfTheTestsAbove) {
  const auto folder = test::shared_data("calib");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool loads = std::any_of(std::begin(kRealFiles), std::end(kRealFiles),
                                   [&](const RealFile& real) { return name == real.name; });
    EXPECT_TRUE(loads || name == "empty.xml" || name == "rs32-angle.csv") << name;
  }
}

TEST(Hdl64eFile, GoesByContentBeforeTheExtension) {
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_hdl64e_xml(folder / "unit.yaml", nominal_hdl64e()));
  EXPECT_TRUE(load_hdl64e_calibration(folder / "unit.yaml").has_value());
  const std::string text = test::content_of(folder / "unit.yaml");
  calib::write_text(folder / "marked", "\xEF\xBB\xBF \n" + text.substr(text.find("<boost")));
  EXPECT_TRUE(load_hdl64e_calibration(folder / "marked").has_value());
}

TEST(Hdl64eFile, NamesWhatWasExpectedForAnythingElse) {
  const test::ScratchFolder folder;
  calib::write_text(folder / "notes.txt", "calibrated on Monday\n");
  EXPECT_THAT(
      load_hdl64e_calibration(folder / "notes.txt"),
      calib::IsRefusedWith(ErrorCode::kUnsupported,
                           AllOf(HasSubstr("notes.txt"), HasSubstr("db.xml"), HasSubstr("YAML"))));
  // What its content does not tell, its name does: YAML that is broken is explained as YAML.
  for (const char* name : {"unit.yaml", "unit.yml"}) {
    calib::write_text(folder / name, "laser: 1\n");
    EXPECT_THAT(
        load_hdl64e_calibration(folder / name),
        calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("a list \"lasers:\", found none")))
        << name;
  }
  calib::write_text(folder / "empty", "");
  EXPECT_FALSE(load_hdl64e_calibration(folder / "empty").has_value());
  EXPECT_THAT(load_hdl64e_calibration(folder / "missing.xml"),
              calib::IsRefusedWith(ErrorCode::kNotFound, HasSubstr("missing.xml")));
  std::filesystem::create_directory(folder / "folder.xml");
  EXPECT_THAT(load_hdl64e_calibration(folder / "folder.xml"),
              calib::IsRefusedWith(ErrorCode::kUnreadable, HasSubstr("is a folder")));
  calib::write_text(folder / "huge.xml", std::string(5U << 20, 'x'));
  EXPECT_THAT(load_hdl64e_calibration(folder / "huge.xml"),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("larger than 4 MiB")));
}

}  // namespace
}  // namespace terracut::hdl64e
