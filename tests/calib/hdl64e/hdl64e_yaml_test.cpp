// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_yaml.hpp"

#include <cmath>
#include <utility>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/text/number_text.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::hdl64e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string values_of(const Hdl64eLaser& laser, int number, const std::string& separator) {
  const std::pair<const char*, double> fields[] = {
      {"rot_correction", laser.rot_correction_rad},
      {"vert_correction", laser.vert_correction_rad},
      {"dist_correction", laser.dist_correction_m},
      {"dist_correction_x", laser.dist_correction_x_m},
      {"dist_correction_y", laser.dist_correction_y_m},
      {"vert_offset_correction", laser.vert_offset_m},
      {"horiz_offset_correction", laser.horiz_offset_m},
      {"focal_distance", laser.focal_distance_m},
      {"focal_slope", laser.focal_slope},
      {"min_intensity", laser.min_intensity},
  };
  std::string text = "laser_id: " + std::to_string(number);
  for (const auto& [key, value] : fields) {
    text += separator + key + ": " + text::text_of(value, 0);
  }
  return text;
}

std::string block_text(int lasers = kHdl64eLasers) {
  std::string text = "# a comment\nnum_lasers: " + std::to_string(lasers) +
                     "\ndistance_resolution: 0.002\nlasers:\n";
  const Hdl64eCalibration nominal = nominal_hdl64e();
  for (int i = 0; i < lasers; ++i) {
    text += "- " + values_of(nominal.lasers[static_cast<std::size_t>(i)], i, "\n  ") + "\n";
  }
  return text;
}

std::string inline_text() {
  std::string text = "lasers:\n";
  const Hdl64eCalibration nominal = nominal_hdl64e();
  for (int i = 0; i < kHdl64eLasers; ++i) {
    text += "- {" + values_of(nominal.lasers[static_cast<std::size_t>(i)], i, ", ") + "}\n";
  }
  return text;
}

Expected<Hdl64eCalibration> parsed(const std::string& text) {
  return parse_hdl64e_yaml(text, "unit.yaml");
}

TEST(Hdl64eYaml, ReadsBothStylesAlike) {
  for (const std::string& text : {block_text(), inline_text()}) {
    const auto read = parsed(text);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->lasers, nominal_hdl64e().lasers);
    EXPECT_EQ(read->distance_resolution_m, 0.002);
    EXPECT_EQ(read->origin, "unit.yaml");
  }
}

TEST(Hdl64eYaml, TakesIntensitiesWrittenAsFloats) {
  const auto read =
      parsed(calib::replaced(block_text(), "min_intensity: 5", "min_intensity: 40.0"));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->lasers[1].min_intensity, 40);
}

TEST(Hdl64eYaml, MissingOptionalKeysHaveTheirDefaults) {
  std::string text = "lasers:\n";
  const Hdl64eCalibration nominal = nominal_hdl64e();
  for (int i = 0; i < kHdl64eLasers; ++i) {
    const auto& laser = nominal.lasers[static_cast<std::size_t>(i)];
    text += "- {laser_id: " + std::to_string(i) + ", rot_correction: 0.01, vert_correction: " +
            std::to_string(laser.vert_correction_rad) + ", dist_correction: 0.1}\n";
  }
  const auto read = parsed(text);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_FALSE(read->lasers[3].two_point);
  EXPECT_EQ(read->lasers[3].min_intensity, 0);
  EXPECT_EQ(read->lasers[3].max_intensity, 255);
  EXPECT_EQ(read->lasers[3].vert_offset_m, 0);
  EXPECT_EQ(read->distance_resolution_m, 0.002);
}

TEST(Hdl64eYaml, TwoPointIsThereByItsValuesUnlessDenied) {
  const std::string text = block_text();
  EXPECT_TRUE(parsed(text)->lasers[0].two_point);
  const auto with_flag = [&](const std::string& value) {
    return parsed(calib::replaced(text, "laser_id: 0\n",
                                  "laser_id: 0\n  two_pt_correction_available: " + value + "\n"));
  };
  EXPECT_TRUE(with_flag("true")->lasers[0].two_point);
  EXPECT_FALSE(with_flag("false")->lasers[0].two_point);
  EXPECT_TRUE(with_flag("false")->lasers[1].two_point);
  EXPECT_THAT(with_flag("maybe"), calib::IsRefusedWith(ErrorCode::kMalformed,
                                                       HasSubstr("two_pt_correction_available")));
}

TEST(Hdl64eYaml, RefusesAnotherModelsNumberOfLasers) {
  EXPECT_THAT(
      parsed(block_text(32)),
      calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("expected 64 lasers, found 32")));
  EXPECT_THAT(parsed(calib::replaced(block_text(), "num_lasers: 64", "num_lasers: 32")),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("num_lasers is 32")));
}

TEST(Hdl64eYaml, RefusesNanAndTextByFileLineLaserAndField) {
  for (const char* bad : {".nan", "nan", ".inf", "abc", "''", "1.2.3", "0,5", "~"}) {
    const std::string text = calib::replaced(block_text(), "dist_correction: 1.1\n",
                                             std::string("dist_correction: ") + bad + "\n");
    EXPECT_THAT(parsed(text), calib::IsRefusedWith(ErrorCode::kMalformed,
                                                   AllOf(HasSubstr("unit.yaml: line 5: laser 0"),
                                                         HasSubstr("dist_correction"))));
  }
}

TEST(Hdl64eYaml, RefusesHugeIntensities) {
  EXPECT_THAT(parsed(calib::replaced(block_text(), "min_intensity: 5", "min_intensity: 1e300")),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("min_intensity")));
}

TEST(Hdl64eYaml, RefusesMissingAndContradictingKeys) {
  EXPECT_THAT(parsed(calib::replaced(block_text(), "  rot_correction:", "  rotation:")),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("rot_correction is missing")));
  EXPECT_THAT(
      parsed(calib::replaced(block_text(),
                             "  rot_correction:", "  dist_correction: 1.3\n  rot_correction:")),
      calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("dist_correction is there twice")));
  EXPECT_TRUE(parsed(calib::replaced(
      block_text(), "  rot_correction:", "  dist_correction: 1.1\n  rot_correction:")));
}

TEST(Hdl64eYaml, RefusesDuplicateAndImpossibleLasers) {
  EXPECT_THAT(parsed(calib::replaced(block_text(), "laser_id: 7\n", "laser_id: 6\n")),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("laser 6 is there twice")));
  for (const char* id : {"64", "-1", "0.5", "1e99", "x"}) {
    EXPECT_THAT(parsed(calib::replaced(block_text(), "laser_id: 7\n",
                                       std::string("laser_id: ") + id + "\n")),
                calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("laser_id")));
  }
}

TEST(Hdl64eYaml, NamesDegreesTakenForRadians) {
  std::string text = block_text();
  for (int i = 0; i < kHdl64eLasers; ++i) {
    const double rad = nominal_hdl64e().lasers[static_cast<std::size_t>(i)].vert_correction_rad;
    const std::size_t at =
        text.find("vert_correction:", text.find("laser_id: " + std::to_string(i) + "\n"));
    text.replace(at, text.find('\n', at) - at,
                 "vert_correction: " + std::to_string(rad * 180 / 3.14159265));
  }
  EXPECT_THAT(parsed(text),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("unit.yaml"), HasSubstr("looks like degrees"))));
}

TEST(Hdl64eYaml, RefusesYamlThatIsNoCalibration) {
  for (const char* text : {"mount: {height_m: 1.7}", "- 1\n- 2\n", "just words", "42", "lasers: 64",
                           "lasers: {a: 1}"}) {
    EXPECT_THAT(parsed(text), calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("lasers:")));
  }
  EXPECT_THAT(parsed("lasers:\n- 3\n"),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("found 1")));
  EXPECT_THAT(parsed(""), calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("is empty")));
  EXPECT_THAT(parsed("# only a comment\n"),
              calib::IsRefusedWith(ErrorCode::kUnsupported, testing::_));
}

TEST(Hdl64eYaml, RefusesBrokenYamlWithTheLine) {
  EXPECT_THAT(parsed("lasers:\n  - {a: 1\n  - b: ]\n"),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("unit.yaml: line ")));
}

TEST(Hdl64eYaml, RefusesAliasesWhichCanBlowUp) {
  std::string bomb = "a: &a [x,x,x,x,x,x,x,x,x]\n";
  for (char c = 'b'; c < 'k'; ++c) {
    const std::string before(1, static_cast<char>(c - 1));
    bomb += std::string(1, c) + ": &" + c + " [";
    for (int i = 0; i < 9; ++i) bomb += "*" + before + ",";
    bomb.back() = ']';
    bomb += "\n";
  }
  EXPECT_THAT(parsed(bomb), calib::IsRefusedWith(ErrorCode::kUnsupported,
                                                 AllOf(HasSubstr("line 2"), HasSubstr("aliases"))));
}

TEST(Hdl64eYaml, RefusesDeepNestingInEveryStyle) {
  for (const char* unit : {"[", "{a: ", "- ", "? ", "a:\n "}) {
    std::string deep;
    for (int i = 0; i < 20000; ++i) deep += unit;
    EXPECT_FALSE(parsed(deep).has_value()) << unit;
  }
  std::string levels = "lasers: ";
  for (int i = 0; i < 12; ++i) levels += "[";
  for (int i = 0; i < 12; ++i) levels += "]";
  EXPECT_THAT(parsed(levels),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("nested deeper")));
}

TEST(Hdl64eYaml, RefusesTooManyValuesAndHugeFiles) {
  std::string many = "lasers: [";
  for (int i = 0; i < 30000; ++i) many += "1,";
  EXPECT_THAT(parsed(many + "]"),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("more than")));
  EXPECT_THAT(parsed(std::string(4U << 20, '[')),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("more than")));
  EXPECT_THAT(parsed(std::string((4U << 20) + 1, 'a')),
              calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("larger than 4 MiB")));
}

TEST(Hdl64eYaml, EveryTruncationIsRefusedOrStillTheSameTable) {
  const std::string text = inline_text();
  for (std::size_t length = 0; length + 40 < text.size(); length += 97) {
    EXPECT_FALSE(parsed(text.substr(0, length)).has_value()) << length;
  }
}

}  // namespace
}  // namespace terracut::hdl64e
