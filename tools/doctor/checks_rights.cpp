// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <linux/capability.h>

#include <charconv>
#include <cstdlib>
#include <limits>
#include <vector>

#include "checks.hpp"

namespace terracut::doctor {
namespace {

constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();
constexpr int kHighestPriority = 80;  // the default priority of the receive thread
/// An upper bound of the memory that `terracut plan` reports plus the process's own.
constexpr std::int64_t kMemoryToLock = std::int64_t{512} << 20;
constexpr double kLeastShare = 0.9;

/// Returns the soft limit in /proc/self/limits.
std::optional<std::int64_t> soft_limit(const SystemView& system, std::string_view name) {
  const std::optional<std::string> limits = system.text("proc/self/limits");
  if (!limits) return std::nullopt;
  const std::vector<std::string> words = words_of(line_after(*limits, name).value_or(""));
  if (words.empty()) return std::nullopt;
  if (words.front() == "unlimited") return kUnlimited;
  return std::strtoll(words.front().c_str(), nullptr, 10);
}

std::string mend_of_limit(std::string_view limit) {
  return fmt::format(
      "setcap cap_sys_nice,cap_ipc_lock,cap_net_raw+ep $(command -v terracut); or a line '$USER - "
      "{}' in /etc/security/limits.d/terracut.conf; the service has the right already",
      limit);
}

}  // namespace

bool has_capability(const SystemView& system, int capability) {
  const std::optional<std::string> status = system.text("proc/self/status");
  const std::optional<std::string> mask = status ? line_after(*status, "CapEff:") : std::nullopt;
  if (!mask) return false;
  std::uint64_t bits = 0;
  const auto [end, error] = std::from_chars(mask->data(), mask->data() + mask->size(), bits, 16);
  return error == std::errc{} && end != mask->data() && ((bits >> capability) & 1U) != 0;
}

Finding check_priority(const SystemView& system) {
  if (has_capability(system, CAP_SYS_NICE)) return ok("priority", "CAP_SYS_NICE: any priority");
  const std::int64_t limit = soft_limit(system, "Max realtime priority").value_or(0);
  if (limit >= kHighestPriority) return ok("priority", fmt::format("up to {} (rtprio)", limit));
  return {"priority", Verdict::kProblem,
          limit == 0 ? std::string("real-time priorities are not allowed")
                     : fmt::format("up to {} only (rtprio)", limit),
          "without them every other program's threads can make frames late",
          mend_of_limit("rtprio 95")};
}

Finding check_locked_memory(const SystemView& system) {
  if (has_capability(system, CAP_IPC_LOCK)) return ok("locked memory", "CAP_IPC_LOCK: no limit");
  const std::int64_t limit = soft_limit(system, "Max locked memory").value_or(0);
  if (limit == kUnlimited) return ok("locked memory", "no limit (memlock)");
  const std::string found = fmt::format("up to {} MiB (memlock)", limit >> 20);
  if (limit >= kMemoryToLock) return ok("locked memory", found);
  return {"locked memory", Verdict::kProblem, found,
          "memory that is not locked can be taken away, and a frame then waits for the disk",
          mend_of_limit("memlock unlimited")};
}

Finding check_raw_capture(const SystemView& system) {
  if (has_capability(system, CAP_NET_RAW)) return ok("capture", "CAP_NET_RAW: allowed");
  return ok("capture", "not allowed (CAP_NET_RAW); only a capture by libpcap needs it");
}

Finding check_realtime_share(const SystemView& system) {
  const std::optional<std::int64_t> runtime = system.number("proc/sys/kernel/sched_rt_runtime_us");
  const std::int64_t period =
      system.number("proc/sys/kernel/sched_rt_period_us").value_or(1'000'000);
  if (!runtime || period <= 0) return ok("real-time share", "not known");
  if (*runtime < 0) return ok("real-time share", "not limited");
  const double share = static_cast<double>(*runtime) / static_cast<double>(period);
  const std::string found = fmt::format("{} of {} us", *runtime, period);
  if (share >= kLeastShare) return ok("real-time share", found);
  return {"real-time share", Verdict::kProblem, found,
          "the kernel stops real-time threads for the rest of the period once they have used it",
          "sysctl -w kernel.sched_rt_runtime_us=950000 kernel.sched_rt_period_us=1000000"};
}

}  // namespace terracut::doctor
