// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/ply_file.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cloud {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\nelement vertex 2\nproperty float x\nproperty int16 n\n"
         "property uchar ring\nelement face 1\nproperty list uchar int "
         "vertex_indices\nend_header\n";
}

std::string error_of(const std::string& content) {
  const auto table = parse_ply(content, "a.ply");
  if (table) return "";
  EXPECT_THAT(table.error().message, HasSubstr("a.ply: "));
  return table.error().message;
}

void expect_the_two_points(const Expected<FieldTable>& table) {
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->points, 2U);
  EXPECT_THAT(*table->field("x"), ElementsAre(1.5, -2));
  EXPECT_THAT(*table->field("n"), ElementsAre(-3, 4));
  EXPECT_THAT(*table->field("ring"), ElementsAre(63, 255));
}

TEST(PlyFile, GivesThePropertiesOfTextByName) {
  expect_the_two_points(parse_ply(header("ascii") + "1.5 -3 63\r\n-2 4 255\n3 0 1 0\n", "a.ply"));
}

TEST(PlyFile, GivesThePropertiesOfBinaryDataInEitherByteOrder) {
  const std::string little("\x00\x00\xC0\x3F\xFD\xFF\x3F\x00\x00\x00\xC0\x04\x00\xFF", 14);
  const std::string big("\x3F\xC0\x00\x00\xFF\xFD\x3F\xC0\x00\x00\x00\x00\x04\xFF", 14);
  expect_the_two_points(parse_ply(header("binary_little_endian") + little, "a.ply"));
  expect_the_two_points(parse_ply(header("binary_big_endian") + big, "a.ply"));
}

TEST(PlyFile, HasNoPropertyThatIsNotThere) {
  const auto table = parse_ply(header("ascii") + "1 1 1\n2 2 2\n", "a.ply");
  ASSERT_TRUE(table);
  EXPECT_FALSE(table->field("y"));
}

TEST(PlyFile, SaysWhereDataAreBroken) {
  EXPECT_THAT(error_of(header("binary_little_endian") + "1234"),
              HasSubstr("truncated: 4 bytes of data, expected 14"));
  EXPECT_THAT(error_of(header("ascii") + "1"), HasSubstr("truncated: 1 bytes"));
  EXPECT_THAT(error_of(header("ascii") + "1 2 3\n1 2\n           "),
              HasSubstr("line 12: 2 values, expected 3"));
  EXPECT_THAT(error_of(header("ascii") + "1 2 3\n1 2 three\n"),
              HasSubstr("line 12: ring is 'three', no number"));
}

TEST(PlyFile, SaysWhatIsWrongWithAHeader) {
  const auto with = [](const std::string& lines) {
    return error_of("ply\nformat ascii 1.0\n" + lines + "end_header\n");
  };
  EXPECT_THAT(error_of(""), HasSubstr("does not begin with the line ply"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\n"), HasSubstr("no line end_header"));
  EXPECT_THAT(error_of("ply\nformat xml 1.0\n"),
              HasSubstr("line 2: format xml 1.0; expected ascii"));
  EXPECT_THAT(error_of("ply\nelement vertex 1\nproperty float x\nend_header\n1\n"),
              HasSubstr("no line format"));
  EXPECT_THAT(with("element face 1\n"), HasSubstr("line 3: its first element is 'face'"));
  EXPECT_THAT(with("element vertex -1\n"), HasSubstr("the vertices' number is none"));
  EXPECT_THAT(with("element vertex 99999999999\nproperty float x\n"), HasSubstr("one frame"));
  EXPECT_THAT(with("element vertex 1\n"), HasSubstr("a vertex has no properties"));
  EXPECT_THAT(with("element vertex 1\nproperty half x\n"), HasSubstr("'half' is no type"));
  EXPECT_THAT(with("element vertex 1\nproperty list float int x\n"),
              HasSubstr("'float' is no type of a property"));
  std::string many = "element vertex 1\n";
  for (int i = 0; i < 65; ++i) many += "property float x\n";
  EXPECT_THAT(with(many), HasSubstr("line 68: a vertex has more than 64 properties"));
  EXPECT_THAT(with("so it goes\n"), HasSubstr("line 3 of its header is none"));
}

TEST(PlyFile, PassesOverListsOfAVertexAndBlankLines) {
  const std::string vertex =
      " 1.0\nelement vertex 2\nproperty float x\nproperty list uchar short views\nproperty int16 "
      "n\n"
      "property uchar ring\nend_header\n";
  expect_the_two_points(
      parse_ply("\xEF\xBB\xBFply\nformat ascii" + vertex + "\n \r\n1.5 2 9 9 -3 63\n\n-2 0 4 255\n",
                "a.ply"));
  const std::string little(
      "\x00\x00\xC0\x3F\x02\x09\x09\x09\x09\xFD\xFF\x3F"
      "\x00\x00\x00\xC0\x00\x04\x00\xFF",
      20);
  expect_the_two_points(parse_ply("ply\nformat binary_little_endian" + vertex + little, "a.ply"));
  EXPECT_THAT(error_of("ply\nformat binary_little_endian" + vertex + little.substr(0, 19)),
              HasSubstr("truncated: its data end in vertex 1 of 2"));
  for (const char* broken :
       {"1.5 9 9 9 -3 63\n", "1.5 -1 -3 63\n", "1.5 1 9 9 -3 63\n", "1.5 0\n"}) {
    EXPECT_THAT(error_of("ply\nformat ascii" + vertex + broken + "-2 0 4 255\n    "),
                HasSubstr("are not those of its 4 properties"))
        << broken;
  }
}

TEST(PlyFile, MayHaveNoVertices) {
  const auto table =
      parse_ply("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "a.ply");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->points, 0U);
}

TEST(PlyFile, SaysThatAFileIsNotThere) {
  EXPECT_EQ(read_ply("nowhere/a.ply").error().code, ErrorCode::kNotFound);
  const test::ScratchFolder folder;
  EXPECT_TRUE(read_ply(folder.write("a.ply", header("ascii") + "1 1 1\n2 2 2\n")));
}

}  // namespace
}  // namespace terracut::cloud
