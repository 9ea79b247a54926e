// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/label_sink.hpp"

#include "small_frame.hpp"

namespace terracut::output {
namespace {

using frame::Label;

using test::content_of;

class LabelSink : public test::InScratchFolder {};

TEST_F(LabelSink, WritesOneLittleEndianClassAReturnInOrder) {
  const std::vector labels{Label::kGround, Label::kObstacle, Label::kOtherGround};
  ASSERT_TRUE(write_label_file(folder_ / "000000.label", labels).has_value());
  const std::string expected("\x28\0\0\0\x63\0\0\0\x31\0\0\0", 12);  // 40, 99, 49
  EXPECT_EQ(content_of(folder_ / "000000.label"), expected);
}

TEST_F(LabelSink, WritesTheNumbersOfObjectsIntoTheUpperHalves) {
  const std::vector labels{Label::kGround, Label::kObstacle, Label::kObstacle};
  const std::vector<std::uint16_t> objects{0, 1, 0x0203};
  ASSERT_TRUE(write_label_file(folder_ / "000000.label", labels, objects).has_value());
  const std::string expected("\x28\0\0\0\x63\0\x01\0\x63\0\x03\x02", 12);
  EXPECT_EQ(content_of(folder_ / "000000.label"), expected);
}

TEST_F(LabelSink, WritesAnEmptyFileForAnEmptyFrame) {
  ASSERT_TRUE(write_label_file(folder_ / "000000.label", {}).has_value());
  EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "000000.label"));
  EXPECT_EQ(content_of(folder_ / "000000.label"), "");
}

}  // namespace
}  // namespace terracut::output
