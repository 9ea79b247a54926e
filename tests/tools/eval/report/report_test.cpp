// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The page of `terracut eval --report`: its numbers are the evaluation's, it is well formed, and a
// browser shows it.
#include "tools/eval/report/report.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "browser.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/eval/made_up_dataset.hpp"
#include "tests/tools/eval/made_up_koblenz.hpp"
#include "tools/eval/evaluation_json.hpp"

namespace terracut::evaluation {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path kCheck = test::source_folder() / "tests/tools/eval/report/check_report.py";

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void replace(std::string& text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

class ReportTest : public testing::Test {
 protected:
  ReportTest() {
    config_.root = dataset_.root();
    config_.methods = {*method_named("terracut"), *method_named("pfaff"), *method_named("paper")};
  }

  void evaluate_all(const std::string& dataset = "semantickitti") {
    const auto outcome =
        evaluate(config_, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
    ASSERT_TRUE(outcome) << outcome.error().message;
    json_ = evaluation_json({dataset, config_.root.string(), config_.methods, false}, classes_,
                            *outcome);
  }
  Status write() {
    return write_report(folder(), {json_, config_, classes_},
                        [&](std::size_t done, std::size_t of) {
                          EXPECT_LE(done, of);
                          done_ = done;
                          of_ = of;
                        });
  }
  [[nodiscard]] fs::path folder() const { return dataset_.root() / "report"; }
  [[nodiscard]] fs::path page() const { return folder() / "index.html"; }

  /// What the checker in Python has to say; empty when nothing is wrong.
  [[nodiscard]] std::string faults_of(const fs::path& page) const {
    std::ofstream(folder() / "eval.json") << json_.dump();
    const fs::path said = folder() / "faults.txt";
    const std::string command = "python3 '" + kCheck.string() + "' '" + page.string() + "' '" +
                                (folder() / "eval.json").string() + "' >'" + said.string() +
                                "' 2>&1";
    return std::system(command.c_str()) == 0 ? "" : content_of(said);
  }
  static bool has_python() { return std::system("python3 --version >/dev/null 2>&1") == 0; }

  MadeUpDataset dataset_;
  EvaluationConfig config_;
  ClassTable classes_ = *ClassTable::parse(kSemanticKittiClasses, "built-in");
  nlohmann::ordered_json json_;
  std::size_t done_ = 0, of_ = 0;
};

TEST_F(ReportTest, ShowsTheNumbersOfTheEvaluationAndIsWellFormed) {
  if (!has_python()) GTEST_SKIP() << "no python3 here";
  evaluate_all();
  ASSERT_TRUE(write());
  EXPECT_EQ(faults_of(page()), "");
  EXPECT_GT(done_, 0U);
  EXPECT_EQ(done_, of_);
}

TEST_F(ReportTest, HasACheckerThatNoticesWrongNumbersAndMarkup) {
  if (!has_python()) GTEST_SKIP() << "no python3 here";
  evaluate_all();
  ASSERT_TRUE(write());
  const std::string good = content_of(page());
  const auto expect_noticed = [&](const std::string& from, const std::string& to,
                                  const std::string& fault) {
    std::string bad = good;
    replace(bad, from, to);
    std::ofstream(folder() / "bad.html", std::ios::binary) << bad;
    EXPECT_THAT(faults_of(folder() / "bad.html"), HasSubstr(fault));
  };
  const std::string cell = R"(data-path="/methods/pfaff/sequences/03/road/iou_g">)";
  expect_noticed(cell, cell + "1", "the page says 1");
  expect_noticed(cell, ">", "pfaff/sequences/03/road/iou_g is not on the page");
  expect_noticed("</section>", "", "closes nothing");
  expect_noticed("data:image/png;base64,", "http://example.org/", "loads");
  expect_noticed("href=\"#average\"", "href=\"#elsewhere\"", "which is not there");
}

TEST_F(ReportTest, SetsThePapersNumbersBesideThem) {
  evaluate_all();
  ASSERT_TRUE(write());
  const std::string html = content_of(page());
  EXPECT_THAT(html, HasSubstr(R"(<td class="paper">48.58</td>)"));    // Table III
  EXPECT_THAT(html, HasSubstr(R"(<td class="paper">47.10</td>)"));    // Table IV
  EXPECT_THAT(html, HasSubstr(R"(<td class="paper">1477.63</td>)"));  // Table VI, not measured here
  // The paper's mean of the sequences that were evaluated, 00 and 03.
  EXPECT_THAT(html, HasSubstr(R"(<td class="paper">43.78</td>)"));
}

TEST_F(ReportTest, KnowsTheMapsOfKoblenzByTheirFolders) {
  const MadeUpKoblenz koblenz;
  config_.root = koblenz.root();
  config_.layout = DatasetLayout::kKoblenz;
  classes_ = *ClassTable::parse(kKoblenzClasses, "built-in");
  evaluate_all("koblenz");
  ASSERT_TRUE(write());
  const std::string html = content_of(page());
  EXPECT_THAT(html, HasSubstr("Table VII"));
  EXPECT_THAT(html, HasSubstr("/methods/paper/sequences/KoblenzFarmMap/road/iou_g"));
  EXPECT_THAT(html, HasSubstr(R"(<td class="paper">44.20</td>)"));  // the mean of Forest and Farm
  EXPECT_THAT(html, Not(HasSubstr("Not shown")));
  if (has_python()) {
    EXPECT_EQ(faults_of(page()), "");
  }
}

TEST_F(ReportTest, SaysWhereThePaperHasNothingToCompareWith) {
  evaluate_all("simulated");
  ASSERT_TRUE(write());
  EXPECT_THAT(content_of(page()), HasSubstr("The paper does not measure on simulated"));
  if (has_python()) {
    EXPECT_EQ(faults_of(page()), "");
  }
}

TEST_F(ReportTest, ShowsSequencesThePaperDoesNotHaveBesideItsOwn) {
  // Ends like one of the paper's, and is none.
  fs::rename(dataset_.root() / "sequences/03", dataset_.root() / "sequences/103");
  evaluate_all();
  ASSERT_TRUE(write());
  const std::string html = content_of(page());
  EXPECT_THAT(html, HasSubstr("<th>10</th><th>103</th>"));
  EXPECT_THAT(html, HasSubstr(R"(<td class="paper">43.67</td>)"));       // the paper's mean of 00
  EXPECT_THAT(html, Not(HasSubstr(R"(<td class="paper">43.78</td>)")));  // ... of 00 and 03
  if (has_python()) {
    EXPECT_EQ(faults_of(page()), "");
  }
}

TEST_F(ReportTest, SaysSoWhereFramesWereNotKept) {
  evaluate_all("simulated");
  const auto html = report_page({json_, config_, classes_, false}, [](std::size_t, std::size_t) {});
  ASSERT_TRUE(html);
  EXPECT_THAT(*html, HasSubstr("The frames were not kept"));
  EXPECT_THAT(*html, Not(HasSubstr("<img")));
  if (!has_python()) return;
  fs::create_directories(folder());
  std::ofstream(page(), std::ios::binary) << *html;
  EXPECT_EQ(faults_of(page()), "");
}

TEST_F(ReportTest, NamesFramesThatCannotBeShownAnyMore) {
  evaluate_all();
  fs::remove(dataset_.labels("03", 1));
  ASSERT_TRUE(write());
  const std::string html = content_of(page());
  EXPECT_THAT(html, ContainsRegex("Not counted: .*000001"));
  EXPECT_THAT(html, ContainsRegex("Not shown: .*000001"));
  EXPECT_EQ(done_, of_);
}

TEST_F(ReportTest, NamesWhatCouldNotBeEvaluated) {
  fs::remove(dataset_.labels("03", 1));
  evaluate_all();
  ASSERT_TRUE(write());
  EXPECT_THAT(content_of(page()), HasSubstr("Not complete"));
  EXPECT_THAT(content_of(page()), HasSubstr("000001.bin: there is no label file for it"));
}

TEST_F(ReportTest, IsWrittenWholeOrNotAtAll) {
  evaluate_all();
  ASSERT_TRUE(write());
  const std::string before = content_of(page());
  json_["methods"]["pfaff"]["frames"].clear();
  const Status refused = write();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNothingCameOut);
  EXPECT_THAT(refused.error().message, HasSubstr("pfaff"));
  EXPECT_EQ(content_of(page()), before);
}

TEST_F(ReportTest, IsShownByABrowserWithoutComplaint) {
  const auto browser = test::Browser::find();
  if (!browser) GTEST_SKIP() << "no chromium here (tools/setup --all installs it)";
  evaluate_all();
  ASSERT_TRUE(write());
  const auto view = browser->open(page(), folder());
  ASSERT_TRUE(view.done);
  EXPECT_THAT(view.console, IsEmpty());
  EXPECT_GT(test::colours_in(view.screenshot), 50U);  // a blank one has one

  // The page has no script; the same one with a script tells what a person would see.
  std::string html = content_of(page());
  replace(html, "default-src 'none'", "default-src 'none'; script-src 'unsafe-inline'");
  replace(html, "</body>", R"(<script>
for (const img of document.images)
  if (img.naturalWidth < 100) console.error('broken picture: ' + img.alt);
if (document.documentElement.scrollWidth > window.innerWidth) console.error('wider than the window');
for (const text of document.querySelectorAll('svg text')) {
  const inner = text.getBoundingClientRect(), outer = text.ownerSVGElement.getBoundingClientRect();
  if (inner.left < outer.left - 1 || inner.right > outer.right + 1)
    console.error('cut off: ' + text.textContent);
}
</script></body>)");
  std::ofstream(folder() / "inspected.html", std::ios::binary) << html;
  EXPECT_THAT(browser->open(folder() / "inspected.html", folder()).console, IsEmpty());

  // And a complaint would be heard: the page itself lets no script run.
  html = content_of(page());
  replace(html, "</body>", "<script>1</script></body>");
  std::ofstream(folder() / "forbidden.html", std::ios::binary) << html;
  EXPECT_THAT(browser->open(folder() / "forbidden.html", folder()).console, Not(IsEmpty()));
}

}  // namespace
}  // namespace terracut::evaluation
