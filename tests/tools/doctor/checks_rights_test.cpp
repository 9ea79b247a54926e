// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <linux/capability.h>

#include "made_up_machine.hpp"

namespace terracut::doctor {
namespace {

class DoctorRights : public MadeUpMachine {};

TEST_F(DoctorRights, ReadsCapabilities) {
  EXPECT_FALSE(has_capability(system(), CAP_NET_RAW)) << "no status file";
  capabilities("0000000000002000");
  EXPECT_TRUE(has_capability(system(), CAP_NET_RAW));
  EXPECT_FALSE(has_capability(system(), CAP_SYS_NICE));
  capabilities("nonsense");
  EXPECT_FALSE(has_capability(system(), CAP_NET_RAW));
}

TEST_F(DoctorRights, PriorityComesFromALimitOrACapability) {
  limits("0", "8388608");
  expect(check_priority(system()), Verdict::kProblem, "not allowed", "rtprio 95");
  limits("20", "8388608");
  expect(check_priority(system()), Verdict::kProblem, "up to 20 only", "cap_sys_nice");
  limits("95", "8388608");
  expect(check_priority(system()), Verdict::kOk, "up to 95");
  limits("0", "8388608");
  capabilities("0000000000800000");
  expect(check_priority(system()), Verdict::kOk, "CAP_SYS_NICE");
}

TEST_F(DoctorRights, LockedMemoryComesFromALimitOrACapability) {
  limits("0", "8388608");
  expect(check_locked_memory(system()), Verdict::kProblem, "up to 8 MiB", "memlock unlimited");
  limits("0", "1073741824");
  expect(check_locked_memory(system()), Verdict::kOk, "up to 1024 MiB");
  limits("0", "unlimited");
  expect(check_locked_memory(system()), Verdict::kOk, "no limit");
  limits("0", "0");
  capabilities("0000000000004000");
  expect(check_locked_memory(system()), Verdict::kOk, "CAP_IPC_LOCK");
}

TEST_F(DoctorRights, CaptureIsNoProblemWithoutTheRight) {
  capabilities("0000000000000000");
  expect(check_raw_capture(system()), Verdict::kOk, "not allowed");
  capabilities("0000000000002000");
  expect(check_raw_capture(system()), Verdict::kOk, "CAP_NET_RAW: allowed");
}

TEST_F(DoctorRights, WantsNearlyAllTimeForRealTimeThreads) {
  expect(check_realtime_share(system()), Verdict::kOk, "not known");
  file("proc/sys/kernel/sched_rt_period_us", "1000000\n");
  file("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
  expect(check_realtime_share(system()), Verdict::kOk, "950000 of 1000000 us");
  file("proc/sys/kernel/sched_rt_runtime_us", "-1\n");
  expect(check_realtime_share(system()), Verdict::kOk, "not limited");
  file("proc/sys/kernel/sched_rt_runtime_us", "100000\n");
  expect(check_realtime_share(system()), Verdict::kProblem, "100000 of", "sysctl -w");
}

}  // namespace
}  // namespace terracut::doctor
