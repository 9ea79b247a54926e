// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/pcd_file.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "firmware_io/cloud/cloud_bytes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::cloud {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

/// A header of two points with x (float), n (int16) and a histogram of two values between them.
std::string header(const std::string& data) {
  return "# a comment\nVERSION .7\nFIELDS x h n\nSIZE 4 1 2\nTYPE F U I\nCOUNT 1 2 1\n"
         "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA " +
         data + "\n";
}

std::string error_of(const std::string& content) {
  const auto cloud = parse_pcd(content, "a.pcd");
  if (cloud) return "";
  EXPECT_THAT(cloud.error().message, HasSubstr("a.pcd: "));
  return cloud.error().message;
}

TEST(PcdFile, GivesTheFieldsOfTextByName) {
  const auto cloud = parse_pcd(header("ascii") + "1.5 7 8 -3\r\nnan 9 9 4", "a.pcd");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->points, 2U);
  EXPECT_THAT(*cloud->field("n"), ElementsAre(-3, 4));
  EXPECT_EQ(cloud->field("x")->front(), 1.5);
  EXPECT_TRUE(std::isnan(cloud->field("x")->back()));
}

TEST(PcdFile, GivesTheFieldsOfBinaryDataByName) {
  const std::string one("\x00\x00\xC0\x3F\x07\x08\xFD\xFF", 8),
      two("\x00\x00\x00\xC0\x09\x09\x04\x00", 8);
  const auto cloud = parse_pcd(header("binary") + one + two, "a.pcd");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_THAT(*cloud->field("x"), ElementsAre(1.5, -2));
  EXPECT_THAT(*cloud->field("n"), ElementsAre(-3, 4));
}

/// Compressed data: their sizes, then what LZF made of all x, all h, all n.
std::string packed(std::uint32_t unpacked_bytes, const std::string& data) {
  std::string sizes(8, '\0');
  const auto packed_bytes = static_cast<std::uint32_t>(data.size());
  std::memcpy(sizes.data(), &packed_bytes, 4);
  std::memcpy(sizes.data() + 4, &unpacked_bytes, 4);
  return header("binary_compressed") + sizes + data;
}

TEST(PcdFile, GivesTheFieldsOfCompressedDataByName) {
  // Four bytes as they are, then the same once more; h is four times 7, then n.
  const std::string data(
      "\x03\x00\x00\xC0\x3F"
      "\x40\x03"
      "\x00\x07"
      "\x20\x00"
      "\x03\xFD\xFF\x04\x00",
      16);
  const auto cloud = parse_pcd(packed(16, data), "a.pcd");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_THAT(*cloud->field("x"), ElementsAre(1.5, 1.5));
  EXPECT_THAT(*cloud->field("n"), ElementsAre(-3, 4));
}

TEST(PcdFile, UnpacksRunsOfMoreThanEightBytes) {
  // 1200 times the same byte: one as it is, then runs of 264, 264, 264, 264 and 143.
  std::string data("\x00\x05", 2);
  for (int i = 0; i < 4; ++i) data += std::string("\xE0\xFF\x00", 3);
  data += std::string("\xE0\x86\x00", 3);
  std::string sizes(8, '\0');
  sizes[0] = static_cast<char>(data.size());
  sizes[4] = static_cast<char>(1200 & 255);
  sizes[5] = static_cast<char>(1200 >> 8);
  const auto cloud = parse_pcd(
      "FIELDS n\nSIZE 1\nTYPE U\nPOINTS 1200\nDATA binary_compressed\n" + sizes + data, "a.pcd");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_THAT(*cloud->field("n"), Each(5));
}

TEST(PcdFile, SaysWhereCompressedDataAreBroken) {
  EXPECT_THAT(error_of(header("binary_compressed") + "1234"), HasSubstr("have no sizes"));
  EXPECT_THAT(error_of(packed(16, "1234").substr(0, packed(16, "").size() + 2)),
              HasSubstr("truncated: 2 bytes of data, expected 4"));
  EXPECT_THAT(error_of(packed(17, "1234")), HasSubstr("17 bytes unpacked, expected 16"));
  for (const std::string& broken :
       {std::string("\x03\x00", 2), std::string("\x40\x03", 2), std::string("\x00\x07\x40", 3),
        std::string("\x00\x07\xE0", 3), std::string("\x00\x07", 2),
        std::string("\x00\x07\xE0\xFF\x00", 5)}) {
    EXPECT_THAT(error_of(packed(16, broken)), HasSubstr("compressed data are broken"));
  }
}

TEST(PcdFile, HasNoFieldThatIsNotThereOrHasSeveralValues) {
  const auto cloud = parse_pcd(header("ascii") + "1 1 1 1\n2 2 2 2\n", "a.pcd");
  ASSERT_TRUE(cloud);
  EXPECT_FALSE(cloud->field("h"));
  EXPECT_FALSE(cloud->field("label"));
  EXPECT_THAT(cloud->names, ElementsAre("x", "n"));
}

TEST(PcdFile, SaysWhereDataAreBroken) {
  EXPECT_THAT(error_of(header("ascii") + "1 1 1 1\n"), HasSubstr("truncated: 8 bytes"));
  EXPECT_THAT(error_of(header("ascii") + "1.2345678 1 1 1"),
              HasSubstr("1 lines of data, expected 2"));
  EXPECT_THAT(error_of(header("ascii") + "1 1 1 1\n2 22222\n"), HasSubstr("line 13: 2 values"));
  EXPECT_THAT(error_of(header("ascii") + "1 1 1 1\n2 2 2 w\n"), HasSubstr("line 13: n is 'w'"));
  EXPECT_THAT(error_of(header("binary") + "1234567"), HasSubstr("truncated: 7 bytes"));
}

TEST(PcdFile, SaysWhatIsWrongWithAHeader) {
  EXPECT_THAT(error_of("\x89PNG\r\n"), HasSubstr("no PCD file"));
  EXPECT_THAT(error_of(""), HasSubstr("no PCD file"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE 4 4\n"), HasSubstr("SIZE has 2 entries for 1 fields"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE 3\n"), HasSubstr("SIZE of field x is '3'"));
  EXPECT_THAT(error_of("FIELDS x\nTYPE Q\n"), HasSubstr("TYPE of field x is 'Q'"));
  EXPECT_THAT(error_of("FIELDS x\nCOUNT -1\n"), HasSubstr("COUNT of field x is '-1'"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE 4\nTYPE F\nWIDTH 1\nDATA ascii\n1\n"),
              HasSubstr("neither a line POINTS nor WIDTH and HEIGHT"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE 4\nTYPE F\nWIDTH 18446744073709551615\nHEIGHT "
                       "18446744073709551615\nDATA ascii\n1\n"),
              HasSubstr("expected at most"));
  EXPECT_THAT(error_of("FIELDS x\nPOINTS 1\nDATA ascii\n1\n"), HasSubstr("lacks SIZE or TYPE"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE 2\nTYPE F\nPOINTS 1\nDATA ascii\n1\n"),
              HasSubstr("a float of 2 bytes"));
  EXPECT_THAT(error_of("FIELDS x\x1b[2J\n"), HasSubstr("named 'x?[2J'"));
  std::string many = "FIELDS";
  for (int i = 0; i < 65; ++i) many += " x";
  EXPECT_THAT(error_of(many + "\nPOINTS 1\nDATA ascii\n1\n"), HasSubstr("more than 64 FIELDS"));
  std::string one_by_one;
  for (int i = 0; i < 65; ++i) one_by_one += "FIELDS x\n";
  EXPECT_THAT(error_of(one_by_one), HasSubstr("line 65: more than 64 FIELDS"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE 4\nTYPE F\nPOINTS 99999999999\nDATA binary\n"),
              HasSubstr("expected at most"));
  EXPECT_THAT(error_of(header("binary_packed")), HasSubstr("expected ascii, binary or binary_c"));
}

TEST(PcdFile, PassesOverFieldsWithoutAValueAndPadding) {
  const std::string without_values =
      "FIELDS x _ n _\nSIZE 1 1 1 1\nTYPE U U U U\nCOUNT 1 0 1 2\nPOINTS 2\nDATA ";
  for (const std::string data : {"ascii\n1 2 0 0\n3 4 0 0\n", "binary\n\1\2__\3\4__"}) {
    const auto cloud = parse_pcd(without_values + data, "a.pcd");
    ASSERT_TRUE(cloud) << cloud.error().message;
    EXPECT_THAT(cloud->names, ElementsAre("x", "n"));
    EXPECT_THAT(*cloud->field("x"), ElementsAre(1, 3));
    EXPECT_THAT(*cloud->field("n"), ElementsAre(2, 4));
  }
}

TEST(PcdFile, IsReadInTheDialectsThatOtherProgramsWrite) {
  const std::string fields = "FIELDS x n\nSIZE 4 1\n", size = "WIDTH 2\nHEIGHT 1\n",
                    points = "POINTS 2\n", data = "DATA ascii\n1.5 7\n-2 8\n";
  for (const std::string& content :
       {fields + "TYPE f u\n" + size + points + data,
        "VERSION .5\nCOLUMNS x n\nSIZE 4 1\nTYPE F U\n" + points + data,
        "\xEF\xBB\xBF" + fields + "TYPE F U\n" + points + data, fields + "TYPE F U\n" + size + data,
        fields + "TYPE F U\n" + points + "DATA ascii\n\n# by hand\n+1.5 +7\r\n \t\r\n-2 8\n\n"}) {
    const auto cloud = parse_pcd(content, "a.pcd");
    ASSERT_TRUE(cloud) << cloud.error().message << "\n" << content;
    EXPECT_THAT(*cloud->field("x"), ElementsAre(1.5, -2));
    EXPECT_THAT(*cloud->field("n"), ElementsAre(7, 8));
  }
  const auto microsoft =
      parse_pcd(fields + "TYPE F U\n" + points + "DATA ascii\n1.#QNAN 7\n-1.#INF 8\n", "a.pcd");
  ASSERT_TRUE(microsoft) << microsoft.error().message;
  EXPECT_TRUE(std::isnan(microsoft->field("x")->front()));
  EXPECT_TRUE(std::isinf(microsoft->field("x")->back()));
  for (const char* none : {"+-1", "++1", "-+1", "- 1", "#1", "1.5#"}) {
    EXPECT_THAT(error_of("FIELDS x\nSIZE 4\nTYPE F\nPOINTS 1\nDATA ascii\n" + std::string(none)),
                testing::Not(testing::IsEmpty()))
        << none;
  }
}

TEST(PcdFile, MayHaveNoPoints) {
  for (const char* data : {"ascii\n", "binary\n", "binary_compressed\n"}) {
    for (const char* size :
         {"WIDTH 0\nHEIGHT 1\nPOINTS 0\n", "WIDTH 0\nHEIGHT 0\n", "POINTS 0\n"}) {
      const auto cloud =
          parse_pcd(std::string("FIELDS x\nSIZE 4\nTYPE F\n") + size + "DATA " + data, "a.pcd");
      ASSERT_TRUE(cloud) << cloud.error().message;
      EXPECT_EQ(cloud->points, 0U);
      EXPECT_THAT(*cloud->field("x"), testing::IsEmpty());
    }
  }
}

TEST(PcdFile, SaysWhereTheSensorStoodUnlessAtTheOrigin) {
  const std::string rest = "FIELDS x\nSIZE 4\nTYPE F\nPOINTS 0\nDATA ascii\n";
  const auto viewpoint = [&](const std::string& values) {
    return parse_pcd("VIEWPOINT " + values + "\n" + rest, "a.pcd")->viewpoint;
  };
  EXPECT_EQ(viewpoint("1.5 -0.6 1.8 1 0 0 0"), (std::array<double, 7>{1.5, -0.6, 1.8, 1, 0, 0, 0}));
  for (const char* none : {"0 0 0 1 0 0 0", "1 2 3 0 0 0 0", "1 2 3", "nan 0 0 1 0 0 0", "a b"}) {
    EXPECT_FALSE(viewpoint(none)) << none;
  }
}

TEST(PcdFile, TakesMemoryForNoMoreWordsThanALineMayHave) {
  // A line of ten megabytes: words of it in a list would take ninety.
  std::string line;
  while (line.size() < 10'000'000) line += "x ";
  EXPECT_THAT(error_of("FIELDS " + line + "\n"), HasSubstr("more than 64 FIELDS"));
  EXPECT_THAT(error_of(header("ascii") + line + "\n"), HasSubstr("more than 4 values"));
  std::vector<std::string_view> words;
  split_words(line, 5, words);
  EXPECT_EQ(words.size(), 5U);
  EXPECT_LE(words.capacity(), 8U);
}

TEST(PcdFile, SaysThatAFileIsNotThere) {
  const auto cloud = read_pcd("nowhere/a.pcd");
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, ErrorCode::kNotFound);
  const test::ScratchFolder folder;
  EXPECT_TRUE(read_pcd(folder.write("a.pcd", header("ascii") + "1 1 1 1\n2 2 2 2\n")));
}

}  // namespace
}  // namespace terracut::cloud
