// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "checks.hpp"

namespace terracut::doctor {
namespace {

constexpr double kStolenShareToWarn = 0.001;
constexpr std::array<const char*, 4> kTimeDaemons{"chronyd", "ntpd", "systemd-timesyn", "ptp4l"};

bool virtual_machine(const SystemView& system) {
  if (system.exists("sys/hypervisor/type")) return true;
  const std::optional<std::string> processors = system.text("proc/cpuinfo");
  if (!processors) return false;
  const std::optional<std::string> flags = line_after(*processors, "flags");
  return flags && std::ranges::count(words_of(*flags), "hypervisor") > 0;
}

}  // namespace

Finding check_kernel(const SystemView& system) {
  const std::string version = system.text("proc/version").value_or("");
  const std::vector<std::string> words = words_of(version);
  const std::string release = words.size() > 2 ? words[2] : "unknown release";
  const auto built_as = [&](std::string_view flavour) {
    return version.find(flavour) != std::string::npos;
  };
  if (system.number("sys/kernel/realtime") == 1 || built_as("PREEMPT_RT")) {
    return ok("kernel", fmt::format("PREEMPT_RT ({})", release));
  }
  const char* flavour = built_as("PREEMPT_DYNAMIC") ? "PREEMPT_DYNAMIC"
                        : built_as("PREEMPT")       ? "PREEMPT"
                                                    : "not preemptible";
  return {"kernel", Verdict::kWarning, fmt::format("{} ({})", flavour, release),
          "drivers and softirqs of such a kernel hold up even threads of the highest priority, at "
          "times for milliseconds",
          "apt-get install linux-image-rt-amd64 (Debian) or pro enable realtime-kernel (Ubuntu); "
          "until then preempt=full on the kernel's command line"};
}

Finding check_machine(const SystemView& system) {
  if (!virtual_machine(system)) return ok("machine", "no sign of a virtual machine");
  const std::string product = system.text("sys/class/dmi/id/product_name").value_or("unnamed");
  return {"machine", Verdict::kWarning, fmt::format("a virtual machine ({})", product),
          "its host can stop every core of it for milliseconds, whatever the priorities inside",
          "use a machine of its own; or pin the virtual cores to real ones on the host"};
}

Finding check_stolen_time(const SystemView& system) {
  const std::optional<std::string> stat = system.text("proc/stat");
  const std::vector<std::string> ticks =
      words_of(stat ? line_after(*stat, "cpu ").value_or("") : "");
  constexpr std::size_t kSteal = 7;  // columns: user nice system idle iowait irq softirq steal
  double all = 0;
  double stolen = 0;
  for (std::size_t i = 0; i <= kSteal && i < ticks.size(); ++i) {
    const double value = std::strtod(ticks[i].c_str(), nullptr);
    all += value;
    if (i == kSteal) stolen = value;
  }
  if (ticks.size() <= kSteal || all <= 0) return ok("stolen time", "not known");
  const std::string found = fmt::format("{:.2f} % of the time since start", 100 * stolen / all);
  if (stolen <= kStolenShareToWarn * all) return ok("stolen time", found);
  return {"stolen time", Verdict::kWarning, found,
          "the host of this virtual machine gives its cores to others; frames are late for it and "
          "no setting in here helps",
          "move the machine to a host that is not shared"};
}

Finding check_clock_source(const SystemView& system) {
  constexpr const char* kFolder = "sys/devices/system/clocksource/clocksource0/";
  const std::string source = system.text(std::string(kFolder) + "current_clocksource").value_or("");
  if (source.empty()) return ok("clock source", "not known");
  constexpr std::array kQuick{"tsc", "kvm-clock", "arch_sys_counter",
                              "hyperv_clocksource_tsc_page"};
  if (std::ranges::count(kQuick, source) > 0) return ok("clock source", source);
  return {"clock source", Verdict::kWarning, source,
          "reading this clock is a system call of microseconds, and every packet's stamp and every "
          "stage reads one",
          "echo tsc > /sys/devices/system/clocksource/clocksource0/current_clocksource; if tsc is "
          "not offered, the kernel's log says why it was given up (dmesg | grep -i tsc)"};
}

Finding check_time_sync(const SystemView& system) {
  std::string daemons;
  for (const char* daemon : kTimeDaemons) {
    if (!system.processes().contains(daemon)) continue;
    daemons += (daemons.empty() ? "" : ", ") + std::string(daemon);
  }
  const std::string by = daemons.empty() ? "no daemon seen" : "by " + daemons;
  if (!system.clock()) return ok("time", fmt::format("state not known, {}", by));
  if (system.clock()->synchronised) {
    return ok("time", fmt::format("synchronised ({}), error at most {:.3g} ms", by,
                                  system.clock()->max_error_s * 1e3));
  }
  return {"time", Verdict::kWarning, fmt::format("not synchronised ({})", by),
          "labels carry this machine's time; other sensors and the vehicle will not agree with it, "
          "and a step of the clock falsifies latencies",
          daemons.empty() ? "apt-get install chrony, or linuxptp where the sensor speaks PTP"
                          : "chronyc tracking, or timedatectl timesync-status, tell what is amiss"};
}

}  // namespace terracut::doctor
