// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/threads/thread_setup.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <iterator>
#include <string_view>

namespace terracut::threads {
namespace {

/// The system call's argument, as it was first (48 bytes); the kernel takes every length since.
/// The GNU C library has neither the call nor the structure before 2.41, and after it under this
/// name, hence the other one here.
struct KernelSchedulingAttributes {
  std::uint32_t size = 48;
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime_ns = 0;
  std::uint64_t deadline_ns = 0;
  std::uint64_t period_ns = 0;
};
static_assert(sizeof(KernelSchedulingAttributes) == 48);

constexpr std::uint32_t kFifo = 1;
constexpr std::uint32_t kDeadline = 6;
constexpr std::uint64_t kResetOnFork = 1;  // else a helper thread would run at our priority

/// 0 or errno.
int set_scheduling(KernelSchedulingAttributes attributes) {
  return ::syscall(SYS_sched_setattr, 0, &attributes, 0U) == 0 ? 0 : errno;
}

/// False where the system does not tell.
bool get_scheduling(KernelSchedulingAttributes& attributes) {
  return ::syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0U) == 0;
}

std::string in_us(std::int64_t time_ns) {
  return std::to_string(time_ns / 1000) + " us";
}

std::string describe(const FifoScheduling& fifo) {
  return "SCHED_FIFO priority " + std::to_string(fifo.priority);
}

std::string describe(const DeadlineScheduling& deadline) {
  return "SCHED_DEADLINE " + in_us(deadline.runtime_ns) + " within " + in_us(deadline.deadline_ns) +
         " every " + in_us(deadline.period_ns);
}

Status check(const ThreadRequest& request) {
  constexpr std::int64_t kShortest_ns = 1024;  // the kernel's own limits
  constexpr std::int64_t kLongest_ns = std::int64_t{1} << 62;
  if (request.name.empty() || request.name.size() > 15) {
    return fail(ErrorCode::kInvalidArgument,
                "the name of a thread has 1 to 15 bytes, not '" + request.name + "'");
  }
  if (request.core && (*request.core < 0 || *request.core >= CPU_SETSIZE)) {
    return fail(ErrorCode::kInvalidArgument, "a core is numbered from 0 to " +
                                                 std::to_string(CPU_SETSIZE - 1) + ", not " +
                                                 std::to_string(*request.core));
  }
  if (const auto* fifo = std::get_if<FifoScheduling>(&request.scheduling)) {
    if (fifo->priority < 1 || fifo->priority > 99) {
      return fail(ErrorCode::kInvalidArgument, "the priority of SCHED_FIFO is from 1 to 99, not " +
                                                   std::to_string(fifo->priority));
    }
  }
  if (const auto* deadline = std::get_if<DeadlineScheduling>(&request.scheduling)) {
    if (deadline->runtime_ns < kShortest_ns || deadline->deadline_ns < deadline->runtime_ns ||
        deadline->period_ns < deadline->deadline_ns || deadline->period_ns > kLongest_ns) {
      return fail(
          ErrorCode::kInvalidArgument,
          "SCHED_DEADLINE needs 1 us <= runtime <= deadline <= period, not " + describe(*deadline));
    }
    if (request.core) {
      return fail(ErrorCode::kInvalidArgument,
                  "SCHED_DEADLINE and a core of one's own exclude each other: the kernel chooses "
                  "the core. Leave one of them out, or give the process a core by a cpuset");
    }
  }
  return {};
}

Grant set_name(const std::string& name) {
  Grant grant{.asked = "name '" + name + "'"};
  grant.error_number = ::pthread_setname_np(::pthread_self(), name.c_str());
  grant.granted = grant.error_number == 0;
  grant.in_force = grant.granted ? "shown by top -H" : "it keeps the name of its process";
  if (!grant.granted) grant.mend = "needs /proc to be mounted";
  return grant;
}

Grant set_core(int core) {
  Grant grant{.asked = "core " + std::to_string(core) + " only"};
  ::cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  if (::sched_setaffinity(0, sizeof cores, &cores) == 0) {
    grant.granted = true;
    grant.in_force = "runs on " + cores_in_force();
    return grant;
  }
  grant.error_number = errno;
  grant.in_force = "may run on cores " + cores_in_force();
  grant.mend =
      "name a core that the machine has and that the container or cpuset of this process holds";
  return grant;
}

void answer(Grant& grant, int error_number, bool deadline) {
  grant.error_number = error_number;
  grant.granted = error_number == 0;
  grant.in_force = "runs as " + scheduling_in_force();
  if (error_number == EPERM) {
    grant.mend = mend_real_time_priority(deadline);
    if (::geteuid() == 0) {
      grant.mend +=
          "; if it has that right already, its control group has no real-time share: "
          "see cpu.rt_runtime_us";
    }
    if (deadline) grant.mend += "; all cores must be allowed, not only " + cores_in_force();
  } else if (error_number == EBUSY) {
    grant.mend =
        "the processors cannot promise so much besides what was promised already: ask for a "
        "shorter runtime or a longer period, or see kernel.sched_rt_runtime_us";
  } else if (error_number != 0) {
    grant.mend = "this kernel does not offer it";
  }
}

Grant set_fifo(const FifoScheduling& fifo) {
  Grant grant{.asked = describe(fifo)};
  answer(grant,
         set_scheduling({.policy = kFifo,
                         .flags = kResetOnFork,
                         .priority = static_cast<std::uint32_t>(fifo.priority)}),
         false);
  return grant;
}

Grant set_deadline(const DeadlineScheduling& deadline) {
  Grant grant{.asked = describe(deadline)};
  answer(grant,
         set_scheduling({.policy = kDeadline,
                         .flags = kResetOnFork,
                         .runtime_ns = static_cast<std::uint64_t>(deadline.runtime_ns),
                         .deadline_ns = static_cast<std::uint64_t>(deadline.deadline_ns),
                         .period_ns = static_cast<std::uint64_t>(deadline.period_ns)}),
         true);
  return grant;
}

}  // namespace

std::string scheduling_in_force() {
  KernelSchedulingAttributes attributes;
  if (!get_scheduling(attributes)) return "unknown scheduling";
  switch (attributes.policy) {
    case kFifo:
      return describe(FifoScheduling{static_cast<int>(attributes.priority)});
    case kDeadline:
      return describe(DeadlineScheduling{static_cast<std::int64_t>(attributes.runtime_ns),
                                         static_cast<std::int64_t>(attributes.deadline_ns),
                                         static_cast<std::int64_t>(attributes.period_ns)});
    default:
      break;
  }
  constexpr std::array<std::string_view, 6> kNames{"SCHED_OTHER", "", "SCHED_RR",
                                                   "SCHED_BATCH", "", "SCHED_IDLE"};
  const bool known = attributes.policy < kNames.size() && !kNames[attributes.policy].empty();
  return known ? std::string(kNames[attributes.policy])
               : "policy " + std::to_string(attributes.policy);
}

std::vector<int> allowed_cores() {
  std::vector<int> allowed;
  ::cpu_set_t cores;
  CPU_ZERO(&cores);
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return allowed;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &cores)) allowed.push_back(core);
  }
  return allowed;
}

std::string cores_in_force() {
  const std::vector<int> cores = allowed_cores();
  std::string list;
  for (auto first = cores.begin(); first != cores.end();) {
    auto last = first;
    while (std::next(last) != cores.end() && *std::next(last) == *last + 1) ++last;
    if (!list.empty()) list += ',';
    list += std::to_string(*first);
    if (last != first) list += '-' + std::to_string(*last);
    first = std::next(last);
  }
  return list;
}

Expected<std::vector<Grant>> set_up_this_thread(const ThreadRequest& request) {
  if (const Status status = check(request); !status) return tl::unexpected(status.error());
  std::vector<Grant> grants{set_name(request.name)};
  if (request.core) grants.push_back(set_core(*request.core));
  if (const auto* fifo = std::get_if<FifoScheduling>(&request.scheduling)) {
    grants.push_back(set_fifo(*fifo));
  } else if (const auto* deadline = std::get_if<DeadlineScheduling>(&request.scheduling)) {
    grants.push_back(set_deadline(*deadline));
  }
  return grants;
}

}  // namespace terracut::threads
