// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <nlohmann/json.hpp>

#include "made_up_machine.hpp"
#include "tools/doctor/report.hpp"

namespace terracut::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DoctorSystemView : public MadeUpMachine {};

TEST_F(DoctorSystemView, ReadsKernelLists) {
  EXPECT_THAT(numbers_of_list("0-2,5"), ElementsAre(0, 1, 2, 5));
  EXPECT_THAT(numbers_of_list("7"), ElementsAre(7));
  for (const char* none : {"", "(null)", "1,x", "-1", "3-", "0-999999999"}) {
    EXPECT_THAT(numbers_of_list(none), IsEmpty()) << none;
  }
}

TEST_F(DoctorSystemView, AbsentFilesAndFoldersAreNone) {
  EXPECT_FALSE(system().text("proc/none"));
  EXPECT_FALSE(system().text("")) << "a folder is no text";
  EXPECT_FALSE(system().number("proc/none"));
  EXPECT_THAT(system().names_in("proc/none"), IsEmpty());
  file("empty", "\n");
  EXPECT_EQ(system().text("empty"), "");
  EXPECT_FALSE(system().number("empty"));
  file("words", "12x\n");
  EXPECT_FALSE(system().number("words"));
}

TEST_F(DoctorSystemView, SeesProcessesByName) {
  process(1, "init");
  file("proc/sys/comm", "not a process\n");
  EXPECT_THAT(system().processes(), ElementsAre("init"));
}

TEST(DoctorReport, SaysWhyAndWhatMendsWhereSomethingIsAmiss) {
  const Findings findings{ok("one", "fine"),
                          {"two", Verdict::kWarning, "so \xff so", "because", "do this"},
                          {"three", Verdict::kProblem, "bad", "therefore", "do that"}};
  const std::string text = text_of(findings);
  EXPECT_THAT(text, HasSubstr("ok       one              fine\n"));
  EXPECT_THAT(text, HasSubstr("mend: do that\n1 problem, 1 warning of 3 checks\n"));
  const auto json = nlohmann::json::parse(json_of(findings));
  EXPECT_EQ(json["problems"], 1);
  EXPECT_EQ(json["findings"][2]["mend"], "do that");
  EXPECT_FALSE(json["findings"][0].contains("why"));
}

}  // namespace
}  // namespace terracut::doctor
