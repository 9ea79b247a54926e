// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/candump_source.hpp"

#include <gmock/gmock.h>

#include <sstream>
#include <vector>

#include "firmware_io/can/can_recording.hpp"
#include "frames.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::test {
namespace {

using can::CandumpSource;
using can::CanFrame;
using can::CanLogCounters;
using testing::HasSubstr;

CandumpSource source_of(const std::string& text, std::string interface = {}) {
  return {std::make_unique<std::istringstream>(text), "drive.log", std::move(interface)};
}

/// Every frame to the end, and the error there if there is one.
template <class Source>
std::pair<std::vector<CanFrame>, std::optional<Error>> read_all(Source& source) {
  std::vector<CanFrame> frames;
  for (;;) {
    const auto next = source.next();
    if (!next) return {frames, next.error()};
    if (!*next) return {frames, std::nullopt};
    frames.push_back(**next);
  }
}

void expect_all_counted(const CanLogCounters& counters) {
  EXPECT_EQ(counters.records,
            counters.delivered + counters.no_frame + counters.other_interface + counters.malformed);
}

TEST(CandumpSource, DeliversTheFramesAmongOtherLinesAndCountsThose) {
  auto source = source_of(
      "# a comment\n"
      "(1.0) can0 123#01\n"
      "(1.1) can0 12#01\n"
      "\n"
      "(1.2) can0 123#0\n"
      "DROPCOUNT: 3\n"
      "(1.3) can0 124#02");
  const auto [frames, error] = read_all(source);
  EXPECT_FALSE(error);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0], data_frame({0x123, false}, {1}, 1'000'000'000));
  EXPECT_EQ(frames[1], data_frame({0x124, false}, {2}, 1'300'000'000));
  EXPECT_EQ(source.counters().records, 7U);
  EXPECT_EQ(source.counters().delivered, 2U);
  EXPECT_EQ(source.counters().no_frame, 3U);
  EXPECT_EQ(source.counters().malformed, 2U);
  EXPECT_THAT(source.first_fault(), HasSubstr("drive.log:3: its id"));
  expect_all_counted(source.counters());
}

TEST(CandumpSource, TakesOneInterfaceOfSeveral) {
  const std::string text = "(1.0) can0 123#01\n(1.1) can1 123#02\n(1.2) can0 123#03\n";
  auto source = source_of(text, "can1");
  const auto [frames, error] = read_all(source);
  EXPECT_FALSE(error);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].data[0], 2);
  EXPECT_EQ(source.counters().other_interface, 2U);

  auto nobody = source_of(text, "can7");
  const auto [none, complaint] = read_all(nobody);
  EXPECT_TRUE(none.empty());
  ASSERT_TRUE(complaint);
  EXPECT_EQ(complaint->code, ErrorCode::kNothingCameOut);
  EXPECT_THAT(complaint->message, HasSubstr("'can7'"));
  EXPECT_THAT(complaint->message, HasSubstr("'can0'"));
}

TEST(CandumpSource, RefusesAFileWithoutAFrameByItsFirstFault) {
  auto source = source_of("  can0  123   [2]  11 22\n(1.0)  can0  123   [2]  11 22\n");
  const auto [frames, error] = read_all(source);
  EXPECT_TRUE(frames.empty());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, ErrorCode::kMalformed);
  EXPECT_THAT(error->message, HasSubstr("drive.log:2:"));
  EXPECT_THAT(error->message, HasSubstr("candump -l"));

  auto empty = source_of("");
  EXPECT_EQ(read_all(empty).second->code, ErrorCode::kMalformed);
}

TEST(CandumpSource, StepsOverLinesHoweverLong) {
  const std::string longest(CandumpSource::kMostLine, 'x');
  auto source = source_of(longest + "\n" + longest + "x\n(1.0) can0 123#01\n" +
                          std::string(100'000, '(') + "\n(1.1) can0 123#02\n" + longest + "x");
  const auto [frames, error] = read_all(source);
  EXPECT_FALSE(error);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].data[0], 2);
  EXPECT_EQ(source.counters().records, 6U);
  EXPECT_EQ(source.counters().no_frame, 1U);
  EXPECT_EQ(source.counters().malformed, 3U);
  EXPECT_THAT(source.first_fault(), HasSubstr("drive.log:2: the line has more than 511"));
}

TEST(CandumpSource, NamesFilesThatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_EQ(CandumpSource::open(folder / "none.log").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(CandumpSource::open(folder.path()).error().code, ErrorCode::kUnreadable);
}

}  // namespace
}  // namespace terracut::test
