// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/eval/comparison.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace terracut::evaluation {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

/// A report of `frames` frames in two sequences whose measures are moved by `gain`.
Json report(int frames, double gain, const std::string& method = "terracut") {
  Json json;
  Json& list = json["methods"][method]["frames"] = Json::array();
  for (int i = 0; i < frames; ++i) {
    list.push_back({{"sequence", i % 2 == 0 ? "00" : "01"},
                    {"frame", std::to_string(i)},
                    {"iou_g", 0.9 + 0.001 * i + gain * (1 + 0.01 * i)},
                    {"recall_o", i == 0 ? Json(nullptr) : Json(0.95)},
                    {"iou_road", 0.4 - gain * (1 + 0.02 * i)},
                    {"ms", 4 + 0.01 * i}});
  }
  return json;
}

const MeasureChange& change_in(const Comparison& comparison, const std::string& measure) {
  for (const MeasureChange& change : comparison.changes) {
    if (change.measure == measure) return change;
  }
  throw std::out_of_range(measure);
}

TEST(ComparisonTest, SaysWhatGotBetterAndWhatGotWorse) {
  const auto comparison = compare(report(30, 0), "terracut", report(30, 0.01), "terracut");
  ASSERT_TRUE(comparison) << comparison.error().message;
  EXPECT_EQ(comparison->frames, 30U);
  const auto& better = change_in(*comparison, "iou_g");
  EXPECT_EQ(better.frames.better, 30U);
  EXPECT_LT(better.frames.p, 1e-5);
  EXPECT_FALSE(better.worse(0.05));
  EXPECT_DOUBLE_EQ(better.sequences.value().p, 0.5);  // two sequences cannot say more
  EXPECT_TRUE(change_in(*comparison, "iou_road").worse(0.05));
}

TEST(ComparisonTest, OfAReportWithItselfFindsNothing) {
  const auto comparison = compare(report(30, 0), "terracut", report(30, 0), "terracut");
  ASSERT_TRUE(comparison);
  for (const MeasureChange& change : comparison->changes) {
    EXPECT_EQ(change.frames.p, 1) << change.measure;
    EXPECT_EQ(change.before, change.after) << change.measure;
    EXPECT_FALSE(change.worse(0.05));
  }
}

TEST(ComparisonTest, IsOverTheFramesBothHave) {
  const auto comparison = compare(report(10, 0), "terracut", report(7, 0.01, "paper"), "paper");
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->frames, 7U);
  EXPECT_EQ(comparison->only_before, 3U);
  EXPECT_EQ(change_in(*comparison, "iou_g").frames.pairs, 7U);
  EXPECT_EQ(change_in(*comparison, "recall_o").frames.pairs, 6U) << "one frame has no obstacle";
}

TEST(ComparisonTest, RefusesWhatCannotBeCompared) {
  const auto no_method = compare(report(3, 0), "zhang", report(3, 0), "terracut");
  ASSERT_FALSE(no_method);
  EXPECT_THAT(no_method.error().message, HasSubstr("there is no method 'zhang'"));
  EXPECT_THAT(no_method.error().message, HasSubstr("only terracut"));
  const auto no_report = compare(Json::object(), "terracut", report(3, 0), "terracut");
  ASSERT_FALSE(no_report);
  EXPECT_EQ(no_report.error().code, ErrorCode::kMalformed);
  const auto nothing_shared = compare(report(3, 0), "terracut", report(0, 0), "terracut");
  ASSERT_FALSE(nothing_shared);
  EXPECT_THAT(nothing_shared.error().message, HasSubstr("no frame in common"));
}

}  // namespace
}  // namespace terracut::evaluation
