// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "made_up_machine.hpp"

namespace terracut::doctor {
namespace {

class DoctorProcessor : public MadeUpMachine {
 protected:
  void cores(const std::string& which, const std::string& list) const {
    file("sys/devices/system/cpu/" + which, list + "\n");
  }
  void governor(int core, const std::string& name) const {
    file("sys/devices/system/cpu/cpu" + std::to_string(core) + "/cpufreq/scaling_governor",
         name + "\n");
  }
};

TEST_F(DoctorProcessor, WantsEveryCoreAtFullSpeed) {
  cores("online", "0-2");
  expect(check_governor(system()), Verdict::kOk, "not changed");
  for (const int core : {0, 1, 2}) governor(core, "performance");
  expect(check_governor(system()), Verdict::kOk, "performance");
  governor(1, "powersave");
  expect(check_governor(system()), Verdict::kWarning, "performance on 0,2; powersave on 1",
         "cpupower");
}

TEST_F(DoctorProcessor, WantsCoresSetApart) {
  cores("online", "0-3");
  cores("isolated", "");
  expect(check_isolated_cores(system(), {}), Verdict::kWarning, "none",
         "isolcpus=managed_irq,domain,3 ");
  const Requests requests{.core = 1};
  expect(check_isolated_cores(system(), requests), Verdict::kWarning, "none", "domain,1 ");
  cores("isolated", "3");
  expect(check_isolated_cores(system(), requests), Verdict::kWarning, "3, but not 1", "isolcpus=");
  cores("isolated", "1-3");
  expect(check_isolated_cores(system(), requests), Verdict::kOk, "1,2,3");
  cores("isolated", "");
  cores("online", "0");
  expect(check_isolated_cores(system(), {}), Verdict::kWarning, "one core only");
}

TEST_F(DoctorProcessor, WantsIsolatedCoresWithoutATick) {
  const Requests requests{.core = 3};
  cores("online", "0-3");
  expect(check_tickless_cores(system(), requests), Verdict::kOk, "none");
  cores("isolated", "2-3");
  expect(check_tickless_cores(system(), requests), Verdict::kWarning, "none", "nohz_full=3 ");
  cores("nohz_full", "2");
  expect(check_tickless_cores(system(), requests), Verdict::kWarning, "2, but not 3");
  cores("nohz_full", "2-3");
  expect(check_tickless_cores(system(), requests), Verdict::kOk, "2,3");
  cores("nohz_full", "(null)");
  expect(check_tickless_cores(system(), requests), Verdict::kWarning, "none");
}

TEST_F(DoctorProcessor, SwapIsAProblemWhereMemoryCannotBeLocked) {
  const std::string head = "Filename\t\t\tType\t\tSize\tUsed\tPriority\n";
  file("proc/swaps", head);
  expect(check_swap(system()), Verdict::kOk, "none");
  file("proc/swaps", head + "/dev/sda2                partition\t999\t0\t-2\n");
  expect(check_swap(system()), Verdict::kProblem, "cannot be locked", "swapoff -a");
  limits("0", "unlimited");
  expect(check_swap(system()), Verdict::kOk, "stays out");
}

TEST_F(DoctorProcessor, WantsHugePagesOnlyOnRequest) {
  const std::string enabled = "sys/kernel/mm/transparent_hugepage/enabled";
  expect(check_huge_pages(system()), Verdict::kOk, "not known");
  file(enabled, "always [madvise] never\n");
  expect(check_huge_pages(system()), Verdict::kOk, "madvise");
  file(enabled, "[always] madvise never\n");
  expect(check_huge_pages(system()), Verdict::kWarning, "always", "echo madvise");
}

}  // namespace
}  // namespace terracut::doctor
