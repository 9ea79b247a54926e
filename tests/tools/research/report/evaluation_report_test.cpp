// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What `terracut eval --report` leaves for a page: the evaluation, and pictures that it names.
#include "tools/research/report/evaluation_report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/scratch_folder.hpp"
#include "tests/tools/research/eval/made_up_dataset.hpp"
#include "tests/tools/research/eval/made_up_koblenz.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/eval/evaluation_json.hpp"

namespace terracut::report {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::SizeIs;
using Json = nlohmann::ordered_json;

class ReportTest : public testing::Test {
 protected:
  ReportTest() {
    config_.root = dataset_.root();
    config_.layout = *datasets::built_in_table("semantickitti")->layout();
    config_.methods = {*eval::method_named("terracut"), *eval::method_named("pfaff"),
                       *eval::method_named("paper")};
  }

  void evaluate_all(const std::string& dataset = "semantickitti") {
    const auto outcome =
        eval::evaluate(config_, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
    ASSERT_TRUE(outcome) << outcome.error().message;
    json_ = eval::evaluation_json({dataset, config_.root.string(), config_.methods, false},
                                  classes_, *outcome);
  }
  Status write(bool on_disk = true) {
    return write_report(folder(), {json_, config_, classes_, on_disk},
                        [&](std::size_t done, std::size_t of) {
                          EXPECT_LE(done, of);
                          done_ = done;
                          of_ = of;
                        });
  }
  [[nodiscard]] fs::path folder() const { return dataset_.root() / "report"; }
  [[nodiscard]] std::string text() const { return test::content_of(folder() / "evaluation.json"); }
  [[nodiscard]] Json report() const { return Json::parse(text(), nullptr, false); }

  eval::MadeUpDataset dataset_;
  eval::EvaluationConfig config_;
  datasets::ClassTable classes_ = *datasets::built_in_table("semantickitti");
  Json json_;
  std::size_t done_ = 0, of_ = 0;
};

TEST_F(ReportTest, IsTheEvaluationAndWhatWasDrawnBesides) {
  evaluate_all();
  ASSERT_TRUE(write());
  const Json written = report();
  for (const auto& [key, value] : json_.items()) EXPECT_EQ(written.at(key), value) << key;
  EXPECT_EQ(written.at("worst_of"), "terracut");
  EXPECT_GT(done_, 0U);
  EXPECT_EQ(done_, of_);
}

TEST_F(ReportTest, NamesEveryPictureThatItDrew) {
  evaluate_all();
  ASSERT_TRUE(write());
  std::set<std::string> named, drawn;
  const Json written = report();
  EXPECT_THAT(written.at("side_by_side"), SizeIs(2));  // the middle frame of either sequence
  for (const Json& shown : written.at("side_by_side")) {
    EXPECT_EQ(shown.at("side_m"), 60);
    EXPECT_THAT(shown.at("methods"), SizeIs(3));
    named.insert(shown.at("truth"));
    for (const Json& file : shown.at("methods")) named.insert(file);
  }
  for (const Json& shown : written.at("worst")) {
    EXPECT_THAT(shown.at("why"), HasSubstr("lowest"));
    for (const char* const file : {"truth", "result", "panorama"}) named.insert(shown.at(file));
  }
  for (const auto& file : fs::directory_iterator(folder() / "pictures")) {
    drawn.insert("pictures/" + file.path().filename().string());
  }
  EXPECT_EQ(named, drawn);
}

TEST_F(ReportTest, ReadsTheFramesOfKoblenzAgain) {
  const eval::MadeUpKoblenz koblenz;
  config_.root = koblenz.root();
  classes_ = *datasets::built_in_table("koblenz");
  config_.layout = *classes_.layout();
  evaluate_all("koblenz");
  ASSERT_TRUE(write());
  const Json written = report();
  for (const Json& shown : written.at("side_by_side")) EXPECT_FALSE(shown.contains("fault"));
}

TEST_F(ReportTest, HasNoPicturesWhereFramesWereNotKept) {
  evaluate_all("simulated");
  ASSERT_TRUE(write(false));
  EXPECT_EQ(report(), json_);
  EXPECT_FALSE(fs::exists(folder() / "pictures"));
}

TEST_F(ReportTest, NamesFramesThatCannotBeShownAnyMore) {
  evaluate_all();
  fs::remove(dataset_.labels("03", 1));
  ASSERT_TRUE(write());
  const Json written = report();
  EXPECT_THAT(written.at("side_by_side").at(1).at("fault").get<std::string>(), HasSubstr("000001"));
  EXPECT_EQ(done_, of_);
}

TEST_F(ReportTest, IsWrittenWholeOrNotAtAll) {
  evaluate_all();
  ASSERT_TRUE(write());
  const std::string before = text();
  json_["methods"]["pfaff"]["frames"].clear();
  const Status refused = write();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNothingCameOut);
  EXPECT_THAT(refused.error().message, HasSubstr("pfaff"));
  EXPECT_EQ(text(), before);
}

}  // namespace
}  // namespace terracut::report
