// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut compare` of two labelings.
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "tests/tools/cli/fleet/relabel_fixture.hpp"
#include "tools/cli/compare/label_changes.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

class Compare : public Relabel {
 protected:
  void write_labels(const std::string& name, const std::vector<std::uint32_t>& ids) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(ids.data()),
               static_cast<std::streamsize>(ids.size() * sizeof(ids[0])));
  }
};

TEST_F(Compare, CountsWhatChangedAndPutsTheMostChangedFirst) {
  write_labels("before/a/000000.label", {40, 40, 99, 99});
  write_labels("after/a/000000.label", {40, 99, 40, 49});
  write_labels("before/b/000000.label", {40, 40, 99, 99});
  write_labels("after/b/000000.label", {40, 40, 99, 99});
  write_labels("before/b/000001.label", {40, 40, 40, 40});
  write_labels("after/b/000001.label", {49, 40, 40, 40});
  const Outcome outcome = run("compare before after --json c.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("drives    2 in both"));
  EXPECT_THAT(outcome.out, HasSubstr("frames    3 compared, 2 differ"));
  EXPECT_THAT(outcome.out, HasSubstr("75.0000 %  a 000000: 1 to obstacle, 2 to ground, 0 else"));
  const auto report = json("c.json");
  EXPECT_EQ(report["all"]["returns"], 12);
  EXPECT_EQ(report["all"]["to_obstacle"], 1);
  EXPECT_EQ(report["all"]["to_ground"], 2);
  EXPECT_EQ(report["all"]["other"], 1) << "road and other ground";
  EXPECT_EQ(report["most"][0]["drive"], "a");
  EXPECT_EQ(report["most"][1]["frame"], "000001");
  EXPECT_EQ(report["most"].size(), 2U);
}

TEST_F(Compare, SaysSoWhereAFolderCannotBeListed) {
  constexpr ::uid_t kNobody = 65534;
  const ::uid_t self = ::geteuid();
  write_labels("labels/a/000000.label", {40});
  write_labels("labels/closed/000000.label", {40});
  EXPECT_TRUE(find_labelling(folder_ / "labels"));
  fs::permissions(folder_, fs::perms(0755));
  fs::permissions(folder_ / "labels/closed", fs::perms::none);
  if (self == 0 && ::seteuid(kNobody) != 0) GTEST_SKIP() << "root reads everything";
  const auto labelling = find_labelling(folder_ / "labels");
  ASSERT_EQ(::seteuid(self), 0);
  fs::permissions(folder_ / "labels/closed", fs::perms::owner_all);
  ASSERT_FALSE(labelling);
  EXPECT_THAT(labelling.error().message, HasSubstr("cannot be listed"));
}

TEST_F(Compare, NamesNoMoreFramesThanItIsAskedFor) {
  for (int i = 0; i < 9; ++i) {
    const std::string name = "a/00000" + std::to_string(i) + ".label";
    write_labels("before/" + name, std::vector<std::uint32_t>(10, 40));
    std::vector<std::uint32_t> after(10, 40);
    for (int changed = 0; changed < (i * 5) % 9; ++changed) after[std::size_t(changed)] = 99;
    write_labels("after/" + name, after);
  }
  EXPECT_EQ(run("compare before after --most 2 --json c.json").exit_code, 0);
  const auto most = json("c.json")["most"];
  ASSERT_EQ(most.size(), 2U);
  EXPECT_EQ(most[0]["frame"], "000007") << "8 of 10";
  EXPECT_EQ(most[1]["frame"], "000005") << "7 of 10";
}

TEST_F(Compare, SaysWhatCannotBeCompared) {
  write_labels("before/a/000000.label", {40, 40});
  write_labels("after/a/000000.label", {40});
  write_labels("before/a/000001.label", {40});
  write_labels("after/a/000002.label", {40});
  write_labels("before/b/000000.label", {40});
  const Outcome outcome = run("compare before after");
  EXPECT_THAT(outcome.out, HasSubstr("1 before alone, 0 after alone"));
  EXPECT_THAT(outcome.out, HasSubstr("2 in one alone, 1 with another number of returns"));
  EXPECT_EQ(run("compare before/b after/a/").exit_code, 0);
  EXPECT_EQ(run("compare before nowhere").exit_code, 3);
  EXPECT_EQ(run("compare before").exit_code, 2);
}

TEST_F(Compare, TakesTwoJobsOfOneFolderAndDrawsWhereTheyDiffer) {
  add_drive("a");
  add_drive("day/b");
  make_manifest();
  expect_done("relabel m.json -o out");
  std::string first;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/.relabel")) {
    if (fs::exists(entry.path() / "job.json")) first = entry.path().filename().string();
  }
  expect_done("relabel m.json -o out --profile paper");
  const Outcome outcome = run("compare out/.relabel/" + first + " out --most 3 --png png");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("drives    2 in both, 0 before alone, 0 after alone"));
  EXPECT_THAT(outcome.out, HasSubstr("frames    26 compared, 26 differ"));
  EXPECT_EQ(files_in(folder_ / "png", ".png"), 3U);
  EXPECT_THAT(run("compare out out").out, HasSubstr("frames    26 compared, 0 differ"));
}

/// A sum says what a file once was.
TEST_F(Compare, ReadsFilesUnlessTheirSumsAreToBeTrusted) {
  for (const char* const side : {"before", "after", "later"}) {
    write_labels(std::string(side) + "/a/000000.label", {40, 40, 99, 99});
    write_labels(std::string(side) + "/a/000001.label", {40, 40, 99, 99});
    ASSERT_TRUE(seal(folder_ / side / "a", {{"drive", "a"}}));
  }
  const auto summed = fs::last_write_time(folder_ / "after/a/SHA256SUMS");
  write_labels("after/a/000000.label", {99, 99, 99, 99});  // as if it had rotten
  fs::last_write_time(folder_ / "after/a/000000.label", summed);
  EXPECT_THAT(run("compare before after").out, HasSubstr("frames    2 compared, 1 differ"));
  const Outcome trusting = run("compare before after --trust-sums --json c.json");
  EXPECT_THAT(trusting.out, HasSubstr("frames    2 compared, 0 differ"));
  EXPECT_THAT(trusting.out, HasSubstr("not read  2 of these frames"));
  EXPECT_EQ(json("c.json")["frames_by_sum"], 2);
  write_labels("later/a/000000.label", {99, 99, 99, 99});  // as somebody would correct it
  fs::last_write_time(
      folder_ / "later/a/000000.label",
      fs::last_write_time(folder_ / "later/a/SHA256SUMS") + std::chrono::seconds(1));
  EXPECT_THAT(run("compare before later --trust-sums").out,
              HasSubstr("frames    2 compared, 1 differ"));
}

TEST_F(Compare, DrawsNothingWhereRecordingsAreNotKnown) {
  write_labels("before/000000.label", {40});
  write_labels("after/000000.label", {99});
  const Outcome outcome = run("compare before after --png png");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("1 differ")) << "what is known is said";
  EXPECT_THAT(outcome.err, HasSubstr("terracut relabel"));
}

TEST(LabelChangeOfAReturn, LooksAtItsClassAlone) {
  EXPECT_EQ(change_between(40, 40 | 7U << 16), LabelChange::kNone) << "an instance's number";
  EXPECT_EQ(change_between(49, 99), LabelChange::kToObstacle);
  EXPECT_EQ(change_between(99, 40), LabelChange::kToGround);
  EXPECT_EQ(change_between(40, 49), LabelChange::kOther);
  EXPECT_EQ(change_between(0, 99), LabelChange::kOther);
}

}  // namespace
}  // namespace terracut::cli
