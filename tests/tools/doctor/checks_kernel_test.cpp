// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "made_up_machine.hpp"

namespace terracut::doctor {
namespace {

class DoctorKernel : public MadeUpMachine {};

TEST_F(DoctorKernel, TellsTheFlavoursApart) {
  file("proc/version", "Linux version 6.1.0-rt (gcc) #1 SMP PREEMPT_RT Debian\n");
  expect(check_kernel(system()), Verdict::kOk, "PREEMPT_RT (6.1.0-rt)");
  file("proc/version", "Linux version 6.8.0 (gcc) #1 SMP PREEMPT_DYNAMIC\n");
  expect(check_kernel(system()), Verdict::kWarning, "PREEMPT_DYNAMIC (6.8.0)", "linux-image-rt");
  file("proc/version", "Linux version 5.4.0 (gcc) #1 SMP PREEMPT\n");
  expect(check_kernel(system()), Verdict::kWarning, "PREEMPT (5.4.0)");
  file("proc/version", "Linux version 5.4.0 (gcc) #1 SMP\n");
  expect(check_kernel(system()), Verdict::kWarning, "not preemptible");
  file("sys/kernel/realtime", "1\n");
  expect(check_kernel(system()), Verdict::kOk, "PREEMPT_RT");
}

TEST_F(DoctorKernel, AMachineThatSaysNothingIsNoProblem) {
  for (const Finding& finding : examine(system(), {})) {
    if (finding.check == "interface") continue;  // without one no packet comes in
    if (finding.check == "priority" || finding.check == "locked memory") continue;
    EXPECT_NE(finding.verdict, Verdict::kProblem) << finding.check;
  }
}

TEST_F(DoctorKernel, KnowsAVirtualMachine) {
  file("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu sse2\n");
  expect(check_machine(system()), Verdict::kOk, "no sign");
  file("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu hypervisor sse2\n");
  file("sys/class/dmi/id/product_name", "KVM\n");
  expect(check_machine(system()), Verdict::kWarning, "KVM", "pin the virtual cores");
}

TEST_F(DoctorKernel, KnowsXenByItsFolder) {
  file("sys/hypervisor/type", "xen\n");
  expect(check_machine(system()), Verdict::kWarning, "virtual machine");
}

TEST_F(DoctorKernel, MeasuresStolenTime) {
  expect(check_stolen_time(system()), Verdict::kOk, "not known");
  file("proc/stat", "cpu  10 0 10 980 0 0 0 0 0 0\ncpu0 1 1 1 1 1 1 1 900 0 0\n");
  expect(check_stolen_time(system()), Verdict::kOk, "0.00 %");
  file("proc/stat", "cpu  10 0 10 930 0 0 0 50 0 0\n");
  expect(check_stolen_time(system()), Verdict::kWarning, "5.00 %");
}

TEST_F(DoctorKernel, WantsAQuickClockSource) {
  const std::string source = "sys/devices/system/clocksource/clocksource0/current_clocksource";
  expect(check_clock_source(system()), Verdict::kOk, "not known");
  for (const char* quick : {"tsc", "kvm-clock", "arch_sys_counter"}) {
    file(source, std::string(quick) + "\n");
    expect(check_clock_source(system()), Verdict::kOk, quick);
  }
  file(source, "hpet\n");
  expect(check_clock_source(system()), Verdict::kWarning, "hpet", "echo tsc");
}

TEST_F(DoctorKernel, WantsASynchronisedClock) {
  expect(check_time_sync(system()), Verdict::kOk, "not known");
  expect(check_time_sync(system(ClockState{false, 16})), Verdict::kWarning, "no daemon seen",
         "install chrony");
  process(700, "chronyd");
  process(701, "bash");
  expect(check_time_sync(system(ClockState{false, 16})), Verdict::kWarning, "chronyd",
         "chronyc tracking");
  expect(check_time_sync(system(ClockState{true, 0.002})), Verdict::kOk, "error at most 2 ms");
}

}  // namespace
}  // namespace terracut::doctor
