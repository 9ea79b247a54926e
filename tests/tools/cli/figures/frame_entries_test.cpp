// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/figures/frame_entries.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class ReportFrames : public test::InScratchFolder {
 protected:
  /// A report of so many frames as a run writes it, and its text as json_text() has it in one
  /// piece.
  void expect_report_of(int frames) const {
    FrameEntries entries(folder_ / "r.json");
    Json report{
        {"input", "a\n \"frames\": []"}, {"frames", Json::array()}, {"summary", {{"n", frames}}}};
    const Json without = report;
    for (int i = 0; i < frames; ++i) {
      const Json entry{{"number", i}, {"losses", Json::object()}, {"ms", {{"decode", i / 8.0}}}};
      entries.add(entry);
      report["frames"].push_back(entry);
    }
    ASSERT_TRUE(entries.write(folder_ / "r.json", without).has_value());
    const std::string text = test::content_of(folder_ / "r.json");
    EXPECT_TRUE(text == json_text(report)) << text.substr(0, 300);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
  }
};

TEST_F(ReportFrames, AreWrittenAsIfTheyHadBeenInMemory) {
  expect_report_of(0);
  expect_report_of(1);
  expect_report_of(5'000);
}

TEST_F(ReportFrames, LeaveNoFileWhereTheRunEndsWithoutReport) {
  {
    FrameEntries entries(folder_ / "r.json");
    for (int i = 0; i < 5'000; ++i) entries.add({{"number", i}, {"losses", Json::object()}});
    EXPECT_TRUE(fs::is_empty(folder_));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ReportFrames, SayThatTheyCannotBeKept) {
  std::ofstream(folder_ / "file") << "x";
  FrameEntries entries(folder_ / "file" / "r.json");
  entries.add({{"number", 0}});
  const Status written = entries.write(folder_ / "file" / "r.json", {{"frames", Json::array()}});
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().code, ErrorCode::kWriteFailed);
  EXPECT_NE(written.error().message.find("r.json"), std::string::npos) << written.error().message;
}

}  // namespace
}  // namespace terracut::cli
