// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tools/doctor/checks.hpp"

namespace terracut::doctor {

/// A machine of the test's own making: files below a scratch folder.
class MadeUpMachine : public test::InScratchFolder {
 protected:
  void file(const std::string& path, const std::string& content) const { write(path, content); }
  void process(int number, const std::string& name) const {
    file("proc/" + std::to_string(number) + "/comm", name + "\n");
  }
  /// A mask as in /proc/self/status.
  void capabilities(const std::string& hexadecimal) const {
    file("proc/self/status", "Name:\tterracut\nCapEff:\t" + hexadecimal + "\nSeccomp:\t0\n");
  }
  void limits(const std::string& priority, const std::string& locked) const {
    file("proc/self/limits",
         "Limit                     Soft Limit           Hard Limit           Units     \n"
         "Max locked memory         " +
             locked + "              " + locked +
             "              bytes\n"
             "Max nice priority         0                    0                    \n"
             "Max realtime priority     " +
             priority + "                    " + priority + "       \n");
  }
  void interface(const std::string& name, const std::string& state = "up") const {
    file("sys/class/net/" + name + "/operstate", state + "\n");
  }

  [[nodiscard]] SystemView system() const { return SystemView(folder_); }
  [[nodiscard]] SystemView system(ClockState clock) const { return SystemView(folder_, clock); }
};

/// The finding's verdict, and that words stand in what was found and, unless ok, how to mend it.
inline void expect(const Finding& finding, Verdict verdict, const std::string& found,
                   const std::string& mend = "") {
  EXPECT_EQ(finding.verdict, verdict) << finding.check << ": " << finding.found;
  EXPECT_THAT(finding.found, testing::HasSubstr(found));
  EXPECT_THAT(finding.mend, testing::HasSubstr(mend));
  EXPECT_EQ(finding.why.empty(), verdict == Verdict::kOk);
  EXPECT_EQ(finding.mend.empty(), verdict == Verdict::kOk);
}

}  // namespace terracut::doctor
