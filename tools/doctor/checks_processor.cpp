// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <vector>

#include "checks.hpp"

namespace terracut::doctor {
namespace {

constexpr const char* kProcessors = "sys/devices/system/cpu/";

std::set<int> list_in(const SystemView& system, std::string_view file) {
  return numbers_of_list(system.text(std::string(kProcessors) + std::string(file)).value_or(""));
}

/// Returns the requested cores that are not among `cores`.
std::set<int> missing_of(const Requests& requests, const std::set<int>& cores) {
  std::set<int> missing;
  if (requests.core && !cores.contains(*requests.core)) missing.insert(*requests.core);
  return missing;
}

std::string cores_text(const std::set<int>& cores, const std::set<int>& missing) {
  if (cores.empty()) return "none";
  return fmt::format("{}, but not {}", fmt::join(cores, ","), fmt::join(missing, ","));
}

/// Returns the core to isolate: the requested one, otherwise the last.
int core_to_free(const SystemView& system, const Requests& requests) {
  if (requests.core) return *requests.core;
  const std::set<int> online = list_in(system, "online");
  return online.empty() ? 0 : *online.rbegin();
}

constexpr const char* kThenGrub =
    " to GRUB_CMDLINE_LINUX in /etc/default/grub, then update-grub and start anew";

}  // namespace

Finding check_governor(const SystemView& system) {
  std::map<std::string, std::set<int>> cores_of;
  for (const int core : list_in(system, "online")) {
    const auto governor =
        system.text(fmt::format("{}cpu{}/cpufreq/scaling_governor", kProcessors, core));
    if (governor) cores_of[*governor].insert(core);
  }
  if (cores_of.empty()) return ok("governor", "frequencies are not changed from here");
  std::string found;
  bool steady = true;
  for (const auto& [governor, cores] : cores_of) {
    found += fmt::format("{}{} on {}", found.empty() ? "" : "; ", governor, fmt::join(cores, ","));
    steady = steady && governor == "performance";
  }
  if (steady) return ok("governor", "performance");
  return {
      "governor", Verdict::kWarning, found,
      "work comes in bursts ten times a second; between them the core slows down, and each frame "
      "begins on a slow one",
      "cpupower frequency-set -g performance"};
}

Finding check_isolated_cores(const SystemView& system, const Requests& requests) {
  const std::set<int> isolated = list_in(system, "isolated");
  const std::set<int> missing = missing_of(requests, isolated);
  if (!isolated.empty() && missing.empty()) {
    return ok("isolated cores", fmt::format("{}", fmt::join(isolated, ",")));
  }
  if (list_in(system, "online").size() == 1) {
    return {"isolated cores", Verdict::kWarning, "there is one core only",
            "everything on the machine shares it with the frames",
            "use a machine with two or more"};
  }
  return {"isolated cores", Verdict::kWarning, cores_text(isolated, missing),
          "other programs, and the kernel's own work for them, run on the cores of the frames",
          fmt::format("add isolcpus=managed_irq,domain,{}{}; and name this core as realtime.core",
                      core_to_free(system, requests), kThenGrub)};
}

Finding check_tickless_cores(const SystemView& system, const Requests& requests) {
  const std::set<int> tickless = list_in(system, "nohz_full");
  const std::set<int> missing = missing_of(requests, tickless);
  if (!tickless.empty() && missing.empty()) {
    return ok("tickless cores", fmt::format("{}", fmt::join(tickless, ",")));
  }
  // Tickless cores matter only if cores are isolated, which the previous check is about.
  if (list_in(system, "isolated").empty()) return ok("tickless cores", "none");
  return {
      "tickless cores", Verdict::kWarning, cores_text(tickless, missing),
      "the kernel's tick and RCU interrupt the isolated cores up to a thousand times a second",
      fmt::format("add nohz_full={0} rcu_nocbs={0}{1}", core_to_free(system, requests), kThenGrub)};
}

Finding check_swap(const SystemView& system) {
  const std::vector<std::string> lines = lines_of(system.text("proc/swaps").value_or(""));
  if (lines.size() < 2) return ok("swap", "none");  // only the header line
  const bool lockable = check_locked_memory(system).verdict == Verdict::kOk;
  if (lockable) return ok("swap", "in use; locked memory stays out");
  return {"swap", Verdict::kProblem, "in use, and memory cannot be locked",
          "a frame that touches memory that was swapped out waits for the disk",
          "swapoff -a, or mend 'locked memory'"};
}

Finding check_huge_pages(const SystemView& system) {
  const std::string modes = system.text("sys/kernel/mm/transparent_hugepage/enabled").value_or("");
  if (modes.empty()) return ok("huge pages", "not known");
  const std::size_t begin = modes.find('[');
  const std::size_t end = modes.find(']');
  const std::string mode =
      begin < end && end != std::string::npos ? modes.substr(begin + 1, end - begin - 1) : modes;
  if (mode != "always") return ok("huge pages", mode);
  return {"huge pages", Verdict::kWarning, mode,
          "the kernel moves memory about to make huge pages of it, and holds up whoever uses it",
          "echo madvise > /sys/kernel/mm/transparent_hugepage/enabled, and "
          "transparent_hugepage=madvise on the kernel's command line"};
}

}  // namespace terracut::doctor
