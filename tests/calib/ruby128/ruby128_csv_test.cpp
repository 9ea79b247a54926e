// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_csv.hpp"

#include <algorithm>
#include <locale>
#include <string>
#include <utility>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::ruby128 {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> nominal_lines() {
  std::vector<std::string> lines(1);
  for (const char c : ruby128_csv_text(nominal_ruby128())) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  lines.pop_back();
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end = "\n") {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

/// The nominal file with another line `number`, from 1.
std::string with_line(std::size_t number, const std::string& line) {
  std::vector<std::string> lines = nominal_lines();
  lines[number - 1] = line;
  return joined(lines);
}

Expected<Ruby128Calibration> parsed(const std::string& text) {
  return parse_ruby128_csv(text, "angle.csv");
}

void expect_nominal(const std::string& text) {
  const auto read = parsed(text);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->channels, nominal_ruby128().channels);
}

TEST(Ruby128Csv, WritesOneLineAChannelInThousandthsOfADegree) {
  const std::vector<std::string> lines = nominal_lines();
  ASSERT_EQ(lines.size(), 128U);
  EXPECT_EQ(lines[0], "-13.565,5.950");
  EXPECT_EQ(lines[5], "-0.290,4.250");
  EXPECT_EQ(lines[35], "-25.000,0.850");
  EXPECT_EQ(lines[127], "-1.690,-5.950");
}

TEST(Ruby128Csv, WritesNoNegativeZero) {
  Ruby128Calibration calibration = nominal_ruby128();
  calibration.channels[1].elevation_rad = beams::deg_to_rad(-0.0002);
  EXPECT_THAT(ruby128_csv_text(calibration), HasSubstr("\n0.000,4.250\n"));
}

TEST(Ruby128Csv, ReadsBackTheSameBitsFromAFile) {
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_ruby128_csv(folder / "angle.csv", nominal_ruby128()).has_value());
  const auto read = read_ruby128_csv(folder / "angle.csv");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->channels, nominal_ruby128().channels);
  EXPECT_EQ(read->origin, (folder / "angle.csv").string());
  EXPECT_FALSE(read->nominal);
}

TEST(Ruby128Csv, RoundingToThousandthsKeepsTheFingerprint) {
  Ruby128Calibration calibration = nominal_ruby128();
  for (std::size_t i = 0; i < calibration.channels.size(); ++i) {
    calibration.channels[i].elevation_rad +=
        beams::deg_to_rad(0.00049 * (static_cast<double>(i % 3) - 1));
    calibration.channels[i].azimuth_offset_rad += beams::deg_to_rad(0.0047);
  }
  const auto read = parsed(ruby128_csv_text(calibration));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(fingerprint(*read), fingerprint(calibration));
  for (std::size_t i = 0; i < calibration.channels.size(); ++i) {
    EXPECT_NEAR(beams::rad_to_deg(read->channels[i].elevation_rad),
                beams::rad_to_deg(calibration.channels[i].elevation_rad), 0.000501);
  }
}

TEST(Ruby128Csv, LetsPassWhatEditorsDoToFiles) {
  expect_nominal("\xEF\xBB\xBF" + joined(nominal_lines()));
  expect_nominal(joined(nominal_lines(), "\r\n"));
  expect_nominal(joined(nominal_lines()) + "\r\n \t\n\n");
  std::string text = joined(nominal_lines());
  text.pop_back();  // no line end at the end
  expect_nominal(text);
  expect_nominal(with_line(1, "  -13.565 ,\t+5.95 "));
  expect_nominal(with_line(36, "-25,8.5e-1"));
}

TEST(Ruby128Csv, KnowsNoLocale) {
  struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const std::string text = ruby128_csv_text(nominal_ruby128());
  const auto read = parsed(text);
  std::locale::global(before);
  EXPECT_THAT(text, StartsWith("-13.565,5.950\n"));
  EXPECT_TRUE(read.has_value() && read->channels == nominal_ruby128().channels);
}

TEST(Ruby128Csv, NamesTheLineThatIsNotNumbers) {
  EXPECT_THAT(parsed(with_line(77, "-2.99,east")),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(StartsWith("angle.csv:77:"), HasSubstr("azimuth offset"),
                                         HasSubstr("\"east\" is not a number"))));
  EXPECT_THAT(parsed(with_line(3, "-4.39 deg,2.55")),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(StartsWith("angle.csv:3:"), HasSubstr("elevation"))));
  EXPECT_THAT(parsed(with_line(128, "-1.69,")),
              calib::IsRefusedWith(ErrorCode::kMalformed, StartsWith("angle.csv:128:")));
  EXPECT_THAT(parsed(with_line(50, "# a comment")),
              calib::IsRefusedWith(ErrorCode::kMalformed, StartsWith("angle.csv:50:")));
}

TEST(Ruby128Csv, RefusesNanAndInfinity) {
  for (const char* bad : {"nan", "NaN", "-nan", "inf", "-inf", ".inf", "1e999"}) {
    EXPECT_THAT(parsed(with_line(9, std::string(bad) + ",5.95")),
                calib::IsRefusedWith(ErrorCode::kMalformed,
                                     AllOf(StartsWith("angle.csv:9:"), HasSubstr("is not finite"))))
        << bad;
    EXPECT_THAT(parsed(with_line(9, std::string("-5.79,") + bad)),
                calib::IsRefusedWith(ErrorCode::kMalformed, StartsWith("angle.csv:9:")))
        << bad;
  }
}

TEST(Ruby128Csv, NamesAHeaderLine) {
  EXPECT_THAT(parsed("vertical,horizontal\n" + joined(nominal_lines())),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(StartsWith("angle.csv:1:"), HasSubstr("no header line"))));
}

TEST(Ruby128Csv, NamesSemicolonsAndDecimalCommas) {
  std::string semicolons = joined(nominal_lines());
  std::replace(semicolons.begin(), semicolons.end(), ',', ';');
  EXPECT_THAT(parsed(semicolons),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(StartsWith("angle.csv:1:"), HasSubstr("semicolon"))));
  std::string commas = joined(nominal_lines());
  std::replace(commas.begin(), commas.end(), '.', ',');
  EXPECT_THAT(parsed(commas),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(StartsWith("angle.csv:1:"), HasSubstr("4 fields"),
                                         HasSubstr("point for decimals"))));
}

TEST(Ruby128Csv, NamesBarsAndTabsBetweenAnglesAndTakesThemForNoHeader) {
  for (const auto& [separator, name] :
       {std::pair{" | ", "vertical bar"}, {"\t", "tab"}, {" ; ", "semicolon"}}) {
    std::string text;
    for (std::string line : nominal_lines()) {
      text += line.replace(line.find(','), 1, separator) + "\n";
    }
    EXPECT_THAT(parsed(text),
                calib::IsRefusedWith(
                    ErrorCode::kMalformed,
                    AllOf(StartsWith("angle.csv:1:"), HasSubstr(name), Not(HasSubstr("header")))));
  }
}

TEST(Ruby128Csv, NamesTheUnitOfAnglesThatAreNotInDegrees) {
  for (const auto& [factor, unit] :
       {std::pair{100.0, "hundredths of a degree"}, {1000.0, "thousandths of a degree"}}) {
    std::string text;
    for (const Ruby128Channel& channel : nominal_ruby128().channels) {
      text += std::to_string(factor * beams::rad_to_deg(channel.elevation_rad)) + "," +
              std::to_string(factor * beams::rad_to_deg(channel.azimuth_offset_rad)) + "\n";
    }
    EXPECT_THAT(parsed(text), calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr(unit)));
  }
}

TEST(Ruby128Csv, NamesTheNumberOfLinesWhenItIsWrong) {
  std::vector<std::string> lines = nominal_lines();
  lines.pop_back();
  EXPECT_THAT(
      parsed(joined(lines)),
      calib::IsRefusedWith(ErrorCode::kMalformed,
                           AllOf(HasSubstr("angle.csv"), HasSubstr("127 lines, expected 128"))));
  lines.resize(80);
  EXPECT_THAT(parsed(joined(lines)),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("Ruby Lite")));
  lines.resize(1);
  EXPECT_THAT(parsed(joined(lines)),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("1 line, expected 128")));
  EXPECT_THAT(parsed(joined(nominal_lines()) + "1,2\n"),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("129 lines, expected 128")));
  for (const char* empty : {"", "\n\r\n  ", "\xEF\xBB\xBF"}) {
    EXPECT_THAT(parsed(empty), calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("is empty")));
  }
}

TEST(Ruby128Csv, RefusesABlankLineInTheMiddle) {
  EXPECT_THAT(parsed(with_line(64, "")),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(StartsWith("angle.csv:64:"), HasSubstr("blank line"))));
}

TEST(Ruby128Csv, ExplainsWhyAzimuthOffsetsAreNeeded) {
  std::vector<std::string> lines = nominal_lines();
  for (std::string& line : lines) line.resize(line.find(','));
  EXPECT_THAT(parsed(joined(lines)),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("elevations only"), HasSubstr("6 degrees"))));
}

TEST(Ruby128Csv, NamesTheFirstLineThatLacksItsAzimuthOffset) {
  EXPECT_THAT(parsed(with_line(20, "-1.29")),
              calib::IsRefusedWith(ErrorCode::kMalformed, AllOf(StartsWith("angle.csv:20:"),
                                                                HasSubstr("no azimuth offset"))));
  EXPECT_THAT(parsed(with_line(1, "-13.565")),
              calib::IsRefusedWith(ErrorCode::kMalformed, StartsWith("angle.csv:2:")));
}

TEST(Ruby128Csv, RefusesATableThatIsNotPlausible) {
  EXPECT_THAT(parsed(with_line(36, "-2.5,0.85")),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("angle.csv"), HasSubstr("the lowest"),
                                         HasSubstr("channel N is line N"))));
}

TEST(Ruby128Csv, MessagesHoldNoControlCharactersOfTheFile) {
  const auto read = parsed(with_line(1, std::string("\x1b[31m\0,\xFF", 8)));
  ASSERT_FALSE(read.has_value());
  for (const char c : read.error().message) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(Ruby128Csv, NamesTheTableOfAnotherSensor) {
  const auto path = test::shared_data("calib/rs32-angle.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data";
  EXPECT_THAT(read_ruby128_csv(path),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("32 lines"), HasSubstr("RS-LiDAR-32"))));
}

TEST(Ruby128Csv, SaysWhatAFileShouldHaveBeen) {
  const test::ScratchFolder folder;
  EXPECT_THAT(read_ruby128_csv(folder / "none.csv"),
              calib::IsRefusedWith(ErrorCode::kNotFound, HasSubstr("RS-Ruby128 angle.csv")));
}

TEST(Ruby128Csv, WritesNothingImplausible) {
  const test::ScratchFolder folder;
  Ruby128Calibration calibration = nominal_ruby128();
  calibration.channels[3] = calibration.channels[2];
  EXPECT_THAT(write_ruby128_csv(folder / "angle.csv", calibration),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("channels 3 and 4")));
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace terracut::ruby128
