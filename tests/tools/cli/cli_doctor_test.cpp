// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <set>

#include "cli_fixture.hpp"
#include "tests/support/places.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

constexpr int kProblemFound = 7;

TEST_F(Cli, DoctorsExitCodeSaysWhetherItFoundAProblem) {
  const Outcome outcome = run("doctor --print-json");
  const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << outcome.out << outcome.err;
  int problems = 0;
  std::set<std::string> names;
  for (const auto& finding : report["findings"]) {
    names.insert(finding["check"].get<std::string>());
    if (finding["verdict"] == "ok") continue;
    EXPECT_NE(finding["why"], "") << finding;
    EXPECT_NE(finding["mend"], "") << finding;
    if (finding["verdict"] == "problem") ++problems;
  }
  EXPECT_EQ(names.size(), report["findings"].size()) << "every check has a name of its own";
  EXPECT_EQ(report["problems"], problems);
  EXPECT_EQ(outcome.exit_code, problems == 0 ? 0 : kProblemFound);
}

TEST_F(Cli, DoctorNamesAnInterfaceThatIsNotThere) {
  const Outcome outcome = run("doctor --interface nosuch0");
  EXPECT_EQ(outcome.exit_code, kProblemFound);
  EXPECT_THAT(outcome.out, HasSubstr("there is no nosuch0"));
}

TEST_F(Cli, DoctorChecksWhatTheConfigurationWants) {
  write("a.yaml", "input: {listen: '0.0.0.0:6699', interface: nosuch1}\n");
  const Outcome outcome = run("--config a.yaml doctor");
  EXPECT_THAT(outcome.out, HasSubstr("there is no nosuch1"));
  EXPECT_THAT(outcome.out, HasSubstr("UDP 6699 is"));
}

TEST_F(Cli, DoctorsChecksStandInTheGuideInTheSameOrder) {
  const std::string guide = content_of(test::source_folder() / "docs/guide/real_time.md");
  const auto report = nlohmann::json::parse(run("doctor --print-json").out, nullptr, false);
  std::size_t before = 0;
  for (const auto& finding : report["findings"]) {
    const std::size_t at = guide.find("`" + finding["check"].get<std::string>() + "`");
    ASSERT_NE(at, std::string::npos) << finding;
    EXPECT_GT(at, before) << finding;
    before = at;
  }
}

}  // namespace
}  // namespace terracut::cli
