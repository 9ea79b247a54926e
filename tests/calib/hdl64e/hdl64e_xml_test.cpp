// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_xml.hpp"

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/calib/calib_test_support.hpp"
#include "tools/lab/tables/hdl64e_xml_writer.hpp"

namespace terracut::hdl64e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The nominal unit's file as text, to be damaged.
std::string nominal_text() {
  const test::ScratchFolder folder;
  EXPECT_TRUE(write_hdl64e_xml(folder / "db.xml", nominal_hdl64e()).has_value());
  return test::content_of(folder / "db.xml");
}

Expected<Hdl64eCalibration> parsed(const std::string& text) {
  return parse_hdl64e_xml(text, "unit.xml");
}

TEST(Hdl64eXml, ReadsBackExactlyWhatItWrote) {
  const auto read = parsed(nominal_text());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->lasers, nominal_hdl64e().lasers);
  EXPECT_EQ(read->distance_resolution_m, nominal_hdl64e().distance_resolution_m);
  EXPECT_EQ(read->origin, "unit.xml");
}

TEST(Hdl64eXml, KeepsLengthsExactAndAnglesToTheLastPlaceForAnyDouble) {
  Hdl64eCalibration odd = nominal_hdl64e();
  for (std::size_t i = 0; i < odd.lasers.size(); ++i) {
    odd.lasers[i].vert_correction_rad += 1e-5 / (3.0 + static_cast<double>(i));
    odd.lasers[i].dist_correction_m += 1e-3 / (7.0 + static_cast<double>(i));
    odd.lasers[i].vert_offset_m /= 3.0;
    odd.lasers[i].horiz_offset_m *= 1e-6;
  }
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_hdl64e_xml(folder / "odd.xml", odd));
  const auto read = read_hdl64e_xml(folder / "odd.xml");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  for (std::size_t i = 0; i < odd.lasers.size(); ++i) {
    EXPECT_DOUBLE_EQ(read->lasers[i].vert_correction_rad, odd.lasers[i].vert_correction_rad);
    EXPECT_EQ(read->lasers[i].dist_correction_m, odd.lasers[i].dist_correction_m);
    EXPECT_EQ(read->lasers[i].vert_offset_m, odd.lasers[i].vert_offset_m);
    EXPECT_EQ(read->lasers[i].horiz_offset_m, odd.lasers[i].horiz_offset_m);
  }
}

TEST(Hdl64eXml, WritesTheUnitsAndPlacesOtherReadersExpect) {
  const std::string text = nominal_text();
  EXPECT_THAT(text, HasSubstr("<distLSB_>0.2</distLSB_>"));
  EXPECT_THAT(text, HasSubstr("<!DOCTYPE boost_serialization>"));
  EXPECT_THAT(text,
              HasSubstr("<px class_id=\"9\" tracking_level=\"1\" version=\"1\" object_id=\"_1\">"));
  EXPECT_THAT(text, HasSubstr("<px class_id_reference=\"9\" object_id=\"_64\">"));
  EXPECT_THAT(text, HasSubstr("<distCorrection_>110</distCorrection_>"));                // cm
  EXPECT_THAT(text, HasSubstr("<horizOffsetCorrection_>2.6</horizOffsetCorrection_>"));  // cm
  EXPECT_THAT(text, HasSubstr("<focalDistance_>1200</focalDistance_>"));                 // cm
  for (const char* list : {"colors_", "enabled_", "intensity_", "minIntensity_", "maxIntensity_"}) {
    EXPECT_THAT(text, HasSubstr(std::string("<") + list));
  }
}

TEST(Hdl64eXml, LasersWithoutTwoPointAreWrittenSoThatNobodyInterpolates) {
  Hdl64eCalibration plain = nominal_hdl64e();
  for (Hdl64eLaser& laser : plain.lasers) laser.two_point = false;
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_hdl64e_xml(folder / "plain.xml", plain));
  const auto read = read_hdl64e_xml(folder / "plain.xml");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  for (const Hdl64eLaser& laser : read->lasers) {
    EXPECT_FALSE(laser.two_point);
    EXPECT_EQ(laser.dist_correction_x_m, laser.dist_correction_m);
    EXPECT_EQ(laser.dist_correction_y_m, laser.dist_correction_m);
  }
  EXPECT_EQ(fingerprint(*read), fingerprint(plain));
}

TEST(Hdl64eXml, WritesNothingWhenTheTableIsNotPlausible) {
  Hdl64eCalibration bad = nominal_hdl64e();
  bad.lasers[4].vert_offset_m = 20;
  const test::ScratchFolder folder;
  EXPECT_THAT(write_hdl64e_xml(folder / "bad.xml", bad),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("laser 4")));
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Hdl64eXml, AFailedWriteLeavesTheOldFileAlone) {
  const test::ScratchFolder folder;
  std::filesystem::create_directories(folder / "db.xml" / "taken");  // a folder by that name
  EXPECT_THAT(write_hdl64e_xml(folder / "db.xml", nominal_hdl64e()),
              calib::IsRefusedWith(ErrorCode::kWriteFailed, HasSubstr("db.xml")));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Hdl64eXml, RefusesNanByLaserAndField) {
  const std::string nan = calib::replaced(nominal_text(), "<vertOffsetCorrection_>20.1<",
                                          "<vertOffsetCorrection_>nan<");
  EXPECT_THAT(parsed(nan),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("unit.xml: laser "),
                                         HasSubstr("<vertOffsetCorrection_> is \"nan\""))));
}

TEST(Hdl64eXml, RefusesTextWhereANumberBelongs) {
  for (const char* bad : {"", " ", "abc", "12 cm", "1,5", "0x12", "1e9999", "--3", "inf"}) {
    const std::string text = calib::replaced(nominal_text(), "<focalDistance_>1200<",
                                             std::string("<focalDistance_>") + bad + "<");
    EXPECT_THAT(parsed(text),
                calib::IsRefusedWith(ErrorCode::kMalformed,
                                     AllOf(HasSubstr("laser 0"), HasSubstr("<focalDistance_>"))));
  }
}

TEST(Hdl64eXml, RefusesHugeValues) {
  const std::string text =
      calib::replaced(nominal_text(), "<distCorrection_>110<", "<distCorrection_>1e200<");
  EXPECT_THAT(parsed(text),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("laser 0"), HasSubstr("distance correction"))));
}

TEST(Hdl64eXml, RefusesAMissingAndARepeatedField) {
  EXPECT_THAT(parsed(calib::replaced(nominal_text(), "rotCorrection_>", "rotation_>")),
              calib::IsRefusedWith(ErrorCode::kMalformed, testing::_));  // tags no longer match
  const std::string missing =
      calib::replaced(nominal_text(), "<distCorrection_>110</distCorrection_>", "");
  EXPECT_THAT(parsed(missing), calib::IsRefusedWith(ErrorCode::kMalformed,
                                                    HasSubstr("<distCorrection_> is missing")));
  const std::string twice = calib::replaced(
      nominal_text(), "<distCorrection_>110</distCorrection_>",
      "<distCorrection_>110</distCorrection_><distCorrection_>111</distCorrection_>");
  EXPECT_THAT(parsed(twice), calib::IsRefusedWith(ErrorCode::kMalformed,
                                                  HasSubstr("<distCorrection_> is there twice")));
}

TEST(Hdl64eXml, RefusesALaserThatIsThereTwiceOrOutOfPlace) {
  EXPECT_THAT(parsed(calib::replaced(nominal_text(), "<id_>7<", "<id_>6<")),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("laser 6 is there twice")));
  for (const char* id : {"64", "-1", "1.5", "1e300"}) {
    EXPECT_THAT(parsed(calib::replaced(nominal_text(), "<id_>7<", std::string("<id_>") + id + "<")),
                calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("expected 0 to 63")));
  }
}

TEST(Hdl64eXml, RefusesFewerThan64Lasers) {
  std::string text = nominal_text();
  for (int laser = 32; laser < 64; ++laser) {
    const std::size_t id = text.find("<id_>" + std::to_string(laser) + "<");
    const std::size_t begin = text.rfind("<item", id);
    text.erase(begin, text.find("</item>", id) + 7 - begin);
  }
  EXPECT_THAT(parsed(text), calib::IsRefusedWith(ErrorCode::kUnsupported,
                                                 HasSubstr("expected 64 lasers, found 32")));
}

TEST(Hdl64eXml, CountsADisabledLaserAsAbsent) {
  std::string text = nominal_text();
  const std::size_t item = text.find("<item>1</item>", text.find("<enabled_>"));
  text.replace(item, 14, "<item>0</item>");
  EXPECT_THAT(parsed(text), calib::IsRefusedWith(ErrorCode::kUnsupported,
                                                 AllOf(HasSubstr("64 enabled lasers, found 63"),
                                                       HasSubstr("laser 0"))));
}

TEST(Hdl64eXml, RefusesAnIntensityListOfTheWrongLength) {
  const std::string text = calib::replaced(nominal_text(), "<minIntensity_>\n\t\t<count>64</count>",
                                           "<minIntensity_>\n\t\t<item>3</item>");
  EXPECT_THAT(parsed(text),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   HasSubstr("<minIntensity_> has 65 items, expected 64")));
}

TEST(Hdl64eXml, RefusesOtherXmlByItsRoot) {
  EXPECT_THAT(parsed("<launch><node/></launch>"),
              calib::IsRefusedWith(ErrorCode::kUnsupported,
                                   AllOf(HasSubstr("boost_serialization"), HasSubstr("<launch>"))));
}

TEST(Hdl64eXml, RefusesEmptyTruncatedAndBrokenFilesWithTheLine) {
  EXPECT_THAT(parsed(""), calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("is empty")));
  const std::string text = nominal_text();
  for (const std::size_t length :
       {std::size_t{1}, std::size_t{40}, text.size() / 4, text.size() / 2, text.size() - 30}) {
    EXPECT_FALSE(parsed(text.substr(0, length)).has_value()) << length;
  }
  EXPECT_THAT(parsed("<a>\n\n<b></a>"),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("unit.xml: line 3")));
}

TEST(Hdl64eXml, RefusesHugeInputByName) {
  EXPECT_THAT(parsed(std::string((4U << 20) + 1, ' ')),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("larger than 4 MiB")));
}

TEST(Hdl64eXml, DeepNestingAndEntitiesDoNoHarm) {
  std::string deep;
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  EXPECT_FALSE(parsed(deep).has_value());
  const std::string bomb =
      "<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>"
      "<boost_serialization><DB><distLSB_>&b;</distLSB_></DB></boost_serialization>";
  EXPECT_FALSE(parsed(bomb).has_value());
}

TEST(Hdl64eXml, NamesAFileThatIsNotThere) {
  EXPECT_THAT(read_hdl64e_xml("/nonexistent/unit.xml"),
              calib::IsRefusedWith(ErrorCode::kNotFound, HasSubstr("/nonexistent/unit.xml")));
}

}  // namespace
}  // namespace terracut::hdl64e
