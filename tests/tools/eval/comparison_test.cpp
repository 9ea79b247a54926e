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

/// Of two reports, A.json and B.json.
Expected<Comparison> compare_reports(const Json& before, const Json& after,
                                     const std::string& method_before = "terracut",
                                     const std::string& method_after = "terracut") {
  return compare({before, "A.json", method_before}, {after, "B.json", method_after});
}

const MeasureChange& change_in(const Comparison& comparison, const std::string& measure) {
  for (const MeasureChange& change : comparison.changes) {
    if (change.measure == measure) return change;
  }
  throw std::out_of_range(measure);
}

TEST(ComparisonTest, SaysWhatGotBetterAndWhatGotWorse) {
  const auto comparison = compare_reports(report(30, 0), report(30, 0.01));
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
  const auto comparison = compare_reports(report(30, 0), report(30, 0));
  ASSERT_TRUE(comparison);
  for (const MeasureChange& change : comparison->changes) {
    EXPECT_EQ(change.frames.p, 1) << change.measure;
    EXPECT_EQ(change.before, change.after) << change.measure;
    EXPECT_FALSE(change.worse(0.05));
  }
}

TEST(ComparisonTest, IsOverTheFramesBothHave) {
  const auto comparison =
      compare_reports(report(10, 0), report(7, 0.01, "paper"), "terracut", "paper");
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->frames, 7U);
  EXPECT_EQ(comparison->only_before, 3U);
  EXPECT_EQ(change_in(*comparison, "iou_g").frames.pairs, 7U);
  EXPECT_EQ(change_in(*comparison, "recall_o").frames.pairs, 6U) << "one frame has no obstacle";
}

TEST(ComparisonTest, RefusesWhatCannotBeCompared) {
  const auto no_method = compare_reports(report(3, 0), report(3, 0), "zhang");
  ASSERT_FALSE(no_method);
  EXPECT_THAT(no_method.error().message, HasSubstr("A.json: there is no method 'zhang'"));
  EXPECT_THAT(no_method.error().message, HasSubstr("only terracut"));
  const auto nothing_shared = compare_reports(report(3, 0), report(0, 0));
  ASSERT_FALSE(nothing_shared);
  EXPECT_THAT(nothing_shared.error().message, HasSubstr("no frame in common"));
}

TEST(ComparisonTest, NamesTheFileThatIsNoReportAndWhatItLacks) {
  const Json good = report(3, 0);
  Json no_frames = good, no_time = good, no_number = good;
  no_frames["methods"]["terracut"].erase("frames");
  no_time["methods"]["terracut"]["frames"][1].erase("ms");
  no_number["methods"]["terracut"]["frames"][1]["iou_g"] = "much";
  const std::pair<Json, std::string> cases[] = {
      {Json::object(), "it has no 'methods'"},
      {Json{{"methods", 1}}, "it has no 'methods'"},
      {no_frames, "its method 'terracut' has no 'frames'"},
      {no_time, "one of its frames has no 'ms'"},
      {no_number, "one of its frames has no 'iou_g'"}};
  for (const auto& [bad, lacks] : cases) {
    const auto refused = compare_reports(good, bad);
    ASSERT_FALSE(refused) << lacks;
    EXPECT_EQ(refused.error().code, ErrorCode::kMalformed);
    EXPECT_THAT(refused.error().message,
                testing::AllOf(HasSubstr("B.json: expected a report"), HasSubstr(lacks)));
  }
}

TEST(ComparisonTest, SaysWhatItJudgesByAndJudgesNoTimes) {
  Json slower = report(30, 0);
  for (Json& frame : slower["methods"]["terracut"]["frames"])
    frame["ms"] = frame["ms"].get<double>() + 1;
  const auto comparison = compare_reports(report(30, 0), slower);
  ASSERT_TRUE(comparison);
  EXPECT_LT(change_in(*comparison, "ms").frames.p, 0.001);
  EXPECT_EQ(comparison->worse(0.05), "");
  EXPECT_THAT(comparison_text(*comparison, 0.05),
              HasSubstr("worse     nothing (by p (frames) below 0.05; ms is not judged)"));
  const auto worse = compare_reports(report(30, 0), report(30, 0.01));
  EXPECT_EQ(worse->worse(0.05), "iou_road");
}

TEST(ComparisonTest, ShowsTheMeansThatEvalPrintsOfTheSameFrames) {
  Json before = report(10, 0), after = report(10, 0.01);
  before["methods"]["terracut"]["mean_over_sequences"] = {{"all", {{"iou_g", 0.953}}},
                                                          {"road", {{"iou_g", 0.5}}}};
  after["methods"]["terracut"]["mean_over_sequences"]["all"]["iou_g"] = 0.954;
  const auto comparison = compare_reports(before, after);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(change_in(*comparison, "iou_g").eval_before, 0.953);
  EXPECT_EQ(change_in(*comparison, "iou_g").eval_after, 0.954);
  EXPECT_EQ(change_in(*comparison, "iou_road").eval_before, 0.5);
  EXPECT_EQ(change_in(*comparison, "ms").eval_before, std::nullopt);
  EXPECT_THAT(comparison_text(*comparison, 0.05), HasSubstr("95.300   95.400"));
  EXPECT_EQ(change_in(*compare_reports(before, report(9, 0)), "iou_g").eval_before, std::nullopt)
      << "not the same frames";
}

}  // namespace
}  // namespace terracut::evaluation
