// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/pcd_writer.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <vector>

#include "small_frame.hpp"

namespace terracut::output {
namespace {

using frame::Label;

/// Reads a field of a point where the header's FIELDS and SIZE lines say it lies.
template <class T>
T field(const std::string& file, std::size_t point, std::size_t offset, std::size_t step = 20) {
  const std::size_t data = file.find("DATA binary\n") + std::strlen("DATA binary\n");
  T value;
  std::memcpy(&value, file.data() + data + point * step + offset, sizeof(T));
  return value;
}

using test::content_of;

class PcdWriter : public test::InScratchFolder {};

TEST_F(PcdWriter, WritesAllFieldsInOrderOfArrival) {
  SmallFrame small;
  small.add(3, 9, 1.0F, 2.0F, 3.0F, Label::kObstacle, 200);
  small.add(0, 5, 4.0F, 5.0F, 0.5F, Label::kGround, 17);
  small.add(3, 9, 6.0F, 7.0F, 8.0F, Label::kObstacle, 1);  // the cell is taken: overflow list
  ASSERT_TRUE(write_pcd(folder_ / "a.pcd", small.image, small.labels).has_value());

  const std::string file = content_of(folder_ / "a.pcd");
  EXPECT_THAT(file, testing::HasSubstr("\nFIELDS x y z intensity ring label\nSIZE 4 4 4 4 2 2\n"));
  EXPECT_THAT(file, testing::HasSubstr("\nWIDTH 3\nHEIGHT 1\n"));
  EXPECT_THAT(file, testing::HasSubstr("\nPOINTS 3\n"));
  EXPECT_EQ(field<float>(file, 0, 0), 1.0F);
  EXPECT_EQ(field<float>(file, 1, 4), 5.0F);
  EXPECT_EQ(field<float>(file, 2, 8), 8.0F);
  EXPECT_EQ(field<float>(file, 1, 12), 17.0F);
  EXPECT_EQ(field<std::uint16_t>(file, 2, 16), 3);
  EXPECT_EQ(field<std::uint16_t>(file, 0, 18), 99);
  EXPECT_EQ(field<std::uint16_t>(file, 1, 18), 40);
  EXPECT_EQ(file.size() - file.find("DATA binary\n") - std::strlen("DATA binary\n"), 3U * 20);
}

TEST_F(PcdWriter, WritesTheHeightOfEachReturnBehindItsLabel) {
  SmallFrame small;
  small.add(3, 9, 1.0F, 2.0F, 3.0F, Label::kObstacle, 200);
  small.add(0, 5, 4.0F, 5.0F, 0.5F, Label::kGround, 17);
  const std::vector heights_m{2.5F, -0.25F};
  ASSERT_TRUE(write_pcd(folder_ / "a.pcd", small.image, small.labels, heights_m).has_value());

  const std::string file = content_of(folder_ / "a.pcd");
  EXPECT_THAT(file, testing::HasSubstr("\nFIELDS x y z intensity ring label height_above_ground\n"
                                       "SIZE 4 4 4 4 2 2 4\nTYPE F F F F U U F\n"
                                       "COUNT 1 1 1 1 1 1 1\n"));
  EXPECT_EQ(field<std::uint16_t>(file, 1, 18, 24), 40);
  EXPECT_EQ(field<float>(file, 0, 20, 24), 2.5F);
  EXPECT_EQ(field<float>(file, 1, 20, 24), -0.25F);
  EXPECT_FALSE(write_pcd(folder_ / "b.pcd", small.image, small.labels, std::vector{1.0F}));
}

TEST_F(PcdWriter, RefusesLabelsThatDoNotFitTheFrame) {
  SmallFrame small;
  small.add(0, 0, 1, 0, 0, Label::kGround);
  small.labels.push_back(Label::kGround);
  const Status status = write_pcd(folder_ / "a.pcd", small.image, small.labels);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.pcd"));
}

}  // namespace
}  // namespace terracut::output
