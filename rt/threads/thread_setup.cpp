// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/threads/thread_setup.hpp"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <iterator>
#include <string_view>

namespace terracut::threads {
namespace {

std::string fifo(int priority) {
  return "SCHED_FIFO priority " + std::to_string(priority);
}

Status check(const ThreadRequest& request) {
  if (request.name.empty() || request.name.size() > 15) {
    return fail(ErrorCode::kInvalidArgument,
                "the name of a thread has 1 to 15 bytes, not '" + request.name + "'");
  }
  if (request.core && (*request.core < 0 || *request.core >= CPU_SETSIZE)) {
    return fail(ErrorCode::kInvalidArgument, "a core is numbered from 0 to " +
                                                 std::to_string(CPU_SETSIZE - 1) + ", not " +
                                                 std::to_string(*request.core));
  }
  if (request.priority < 0 || request.priority > 99) {
    return fail(ErrorCode::kInvalidArgument, "the priority of SCHED_FIFO is from 1 to 99, not " +
                                                 std::to_string(request.priority));
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

Grant set_priority(int priority) {
  Grant grant{.asked = fifo(priority)};
  const ::sched_param param{.sched_priority = priority};
  // Without SCHED_RESET_ON_FORK, threads created by this one would run at its priority.
  grant.granted = ::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &param) == 0;
  if (!grant.granted) grant.error_number = errno;
  grant.in_force = "runs as " + scheduling_in_force();
  if (grant.error_number == EPERM) {
    grant.mend = mend_real_time_priority();
    if (::geteuid() == 0) {
      grant.mend +=
          "; if it has that right already, its control group has no real-time share: "
          "see cpu.rt_runtime_us";
    }
  } else if (!grant.granted) {
    grant.mend = "this kernel does not offer it";
  }
  return grant;
}

}  // namespace

std::string scheduling_in_force() {
  const int scheduler = ::sched_getscheduler(0);
  if (scheduler < 0) return "unknown scheduling";
  const auto policy = static_cast<std::size_t>(scheduler & ~SCHED_RESET_ON_FORK);
  if (policy == SCHED_FIFO) {
    ::sched_param param{};
    ::sched_getparam(0, &param);
    return fifo(param.sched_priority);
  }
  constexpr std::array<std::string_view, 7> kNames{
      "SCHED_OTHER", "", "SCHED_RR", "SCHED_BATCH", "", "SCHED_IDLE", "SCHED_DEADLINE"};
  const bool known = policy < kNames.size() && !kNames[policy].empty();
  return known ? std::string(kNames[policy]) : "policy " + std::to_string(policy);
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
  if (request.priority > 0) grants.push_back(set_priority(request.priority));
  return grants;
}

}  // namespace terracut::threads
