// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/capability.h>

#include <algorithm>
#include <array>
#include <vector>

#include "checks.hpp"

namespace terracut::doctor {
namespace {

constexpr const char* kInterfaces = "sys/class/net/";
/// The packet rate of the fastest sensor, an RS-Ruby128 with one return, and the bytes that the
/// kernel books for one of its packets of 1248 bytes. The kernel grants twice the requested buffer.
constexpr double kPacketsPerSecond = 5833;
constexpr double kBookedBytes = 2304;
constexpr double kLeastBuffered_ms = 100;  // the packets of one frame

std::string in_interface(const std::string& interface, std::string_view rest) {
  return fmt::format("{}{}/{}", kInterfaces, interface, rest);
}

bool is_up(const SystemView& system, const std::string& interface) {
  return system.text(in_interface(interface, "operstate")) == "up";
}

/// Returns the sensor's interface; all interfaces that are up if none was named.
std::vector<std::string> interfaces_of(const SystemView& system, const Requests& requests) {
  if (!requests.interface.empty()) return {requests.interface};
  std::vector<std::string> names = system.names_in(kInterfaces);
  std::erase_if(names,
                [&](const std::string& name) { return name == "lo" || !is_up(system, name); });
  return names;
}

/// Returns an interface's interrupt numbers: those that its device lists or, if it lists none,
/// those named like the interface in /proc/interrupts.
std::set<int> interrupts_of(const SystemView& system, const std::string& interface) {
  std::set<int> numbers;
  for (const std::string& name : system.names_in(in_interface(interface, "device/msi_irqs"))) {
    for (const int number : numbers_of_list(name)) numbers.insert(number);
  }
  if (!numbers.empty()) return numbers;
  for (const std::string& line : lines_of(system.text("proc/interrupts").value_or(""))) {
    const std::vector<std::string> words = words_of(line);
    if (words.size() < 2 || !words.front().ends_with(':')) continue;
    const std::string& name = words.back();
    if (name != interface && !name.starts_with(interface + "-")) continue;
    const std::string number = words.front().substr(0, words.front().size() - 1);
    for (const int parsed : numbers_of_list(number)) numbers.insert(parsed);
  }
  return numbers;
}

/// Returns a counter of proc/net/snmp. That file has two lines for each protocol, which both begin
/// with its name: first the names of the counters, then their values.
std::optional<std::int64_t> protocol_counter(const SystemView& system, std::string_view protocol,
                                             std::string_view name) {
  std::vector<std::string> names;
  for (const std::string& line : lines_of(system.text("proc/net/snmp").value_or(""))) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words.front() != protocol) continue;
    if (names.empty()) {
      names = words;
      continue;
    }
    const auto column = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (column >= words.size()) return std::nullopt;
    return std::strtoll(words[column].c_str(), nullptr, 10);
  }
  return std::nullopt;
}

/// True if some socket is bound to the UDP port, by proc/net/udp.
bool port_taken(const SystemView& system, std::uint16_t port) {
  const std::string ending = fmt::format(":{:04X}", port);
  for (const std::string& line : lines_of(system.text("proc/net/udp").value_or(""))) {
    const std::vector<std::string> words = words_of(line);
    if (words.size() > 1 && words[1].ends_with(ending)) return true;
  }
  return false;
}

}  // namespace

Finding check_interface(const SystemView& system, const Requests& requests) {
  const std::vector<std::string> names = interfaces_of(system, requests);
  if (names.empty()) {
    return {"interface", Verdict::kProblem, "no network interface is up", "no packet can come in",
            "ip link set INTERFACE up; look at the cable and the sensor"};
  }
  if (requests.interface.empty()) {
    return ok("interface", fmt::format("up: {}", fmt::join(names, ", ")));
  }
  if (!system.exists(in_interface(requests.interface, ""))) {
    return {"interface", Verdict::kProblem, fmt::format("there is no {}", requests.interface),
            "no packet can come in",
            fmt::format("name one of: {}", fmt::join(system.names_in(kInterfaces), ", "))};
  }
  const std::string state =
      system.text(in_interface(requests.interface, "operstate")).value_or("unknown");
  // Loopback and tunnels have no link, so their state is "unknown".
  if (state == "up" || state == "unknown") {
    return ok("interface", fmt::format("{} is {}", requests.interface, state));
  }
  return {"interface", Verdict::kProblem, fmt::format("{} is {}", requests.interface, state),
          "no packet can come in",
          fmt::format("ip link set {} up; look at the cable and the sensor", requests.interface)};
}

Finding check_receive_buffer(const SystemView& system, const Requests& requests) {
  const std::optional<std::int64_t> most = system.number("proc/sys/net/core/rmem_max");
  if (!most) return ok("receive buffer", "limit not known");
  const auto milliseconds = [](std::int64_t bytes) {
    return 2.0 * static_cast<double>(bytes) / kBookedBytes / kPacketsPerSecond * 1e3;
  };
  const std::int64_t granted = std::min(*most, requests.buffer_bytes);
  const std::string found = fmt::format("{} KiB (rmem_max {}) hold {:.0f} ms of packets",
                                        granted >> 10, *most, milliseconds(granted));
  if (*most >= requests.buffer_bytes) return ok("receive buffer", found);
  // The doctor is often run by root, but the service does not have root's rights.
  const bool passes = has_capability(system, CAP_NET_ADMIN);
  const bool too_little = milliseconds(granted) < kLeastBuffered_ms;
  return {"receive buffer", too_little && !passes ? Verdict::kProblem : Verdict::kWarning,
          passes ? found + "; CAP_NET_ADMIN passes the limit, but the service has no such right"
                 : found,
          "when the program is held up for longer, the kernel throws packets away",
          fmt::format("sysctl -w net.core.rmem_max={0}; to keep it: echo net.core.rmem_max={0} > "
                      "/etc/sysctl.d/60-terracut.conf",
                      requests.buffer_bytes)};
}

Finding check_interrupts(const SystemView& system, const Requests& requests) {
  std::set<int> kept = numbers_of_list(system.text("sys/devices/system/cpu/isolated").value_or(""));
  if (requests.core) kept.insert(*requests.core);
  std::string everywhere;
  std::size_t seen = 0;
  std::vector<int> on_kept;
  for (const std::string& interface : interfaces_of(system, requests)) {
    for (const int interrupt : interrupts_of(system, interface)) {
      const std::string folder = fmt::format("proc/irq/{}/", interrupt);
      std::optional<std::string> list = system.text(folder + "effective_affinity_list");
      if (!list || list->empty()) list = system.text(folder + "smp_affinity_list");
      if (!list) continue;
      ++seen;
      everywhere += fmt::format("{}{} on {}", everywhere.empty() ? "" : "; ", interrupt, *list);
      const std::set<int> cores = numbers_of_list(*list);
      if (std::ranges::any_of(cores, [&](int core) { return kept.contains(core); })) {
        on_kept.push_back(interrupt);
      }
    }
  }
  if (seen == 0) return ok("interrupts", "the interface's interrupts are not known");
  if (on_kept.empty()) return ok("interrupts", everywhere);
  return {
      "interrupts", Verdict::kWarning,
      fmt::format("{} on the frames' cores {} ({})", fmt::join(on_kept, ", "), fmt::join(kept, ","),
                  everywhere),
      "each packet interrupts the threads that have a deadline",
      fmt::format("for i in {}; do echo 0 > /proc/irq/$i/smp_affinity_list; done (with irqbalance "
                  "stopped, or IRQBALANCE_BANNED_CPULIST set)",
                  fmt::join(on_kept, " "))};
}

Finding check_interface_drops(const SystemView& system, const Requests& requests) {
  constexpr std::array<std::string_view, 4> kCounters{"rx_missed_errors", "rx_fifo_errors",
                                                      "rx_crc_errors", "rx_dropped"};
  std::string found;
  bool known = false;
  for (const std::string& interface : interfaces_of(system, requests)) {
    for (const std::string_view counter : kCounters) {
      const auto count =
          system.number(in_interface(interface, "statistics/" + std::string(counter)));
      known = known || count.has_value();
      if (count.value_or(0) == 0) continue;
      found += fmt::format("{}{} {} {}", found.empty() ? "" : "; ", interface, counter, *count);
    }
  }
  if (found.empty()) return ok("interface drops", known ? "none since start" : "not known");
  return {"interface drops", Verdict::kWarning, found,
          "packets were lost before any program saw them; look whether the counts grow "
          "(rx_dropped also counts frames of no protocol known here, which is harmless)",
          "ethtool -G INTERFACE rx 4096; crc errors: cable and connectors"};
}

Finding check_socket_drops(const SystemView& system) {
  const std::optional<std::int64_t> drops = protocol_counter(system, "Udp:", "RcvbufErrors");
  if (!drops) return ok("socket drops", "not known");
  if (*drops == 0) return ok("socket drops", "none since start");
  return {"socket drops", Verdict::kWarning, fmt::format("{} since start, of all programs", *drops),
          "receive buffers were full: some program read too late or asked for too little",
          "mend 'receive buffer' and 'priority'; nstat -az UdpRcvbufErrors shows whether it grows"};
}

Finding check_port(const SystemView& system, const Requests& requests) {
  if (!port_taken(system, requests.port)) {
    return ok("port", fmt::format("UDP {} is free", requests.port));
  }
  return {"port", Verdict::kWarning, fmt::format("UDP {} is taken", requests.port),
          "a second program gets nothing of what a sensor sends to one address; it may be terracut "
          "itself that listens",
          fmt::format("ss -ulpn 'sport = :{}' names the program; --share-port lets both hear "
                      "broadcasts and multicasts",
                      requests.port)};
}

Finding check_return_path(const SystemView& system, const Requests& requests) {
  constexpr const char* kFolder = "proc/sys/net/ipv4/conf/";
  constexpr std::int64_t kStrict = 1;
  const std::int64_t all = system.number(std::string(kFolder) + "all/rp_filter").value_or(0);
  std::vector<std::string> strict;
  for (const std::string& interface : interfaces_of(system, requests)) {
    const auto own = system.number(fmt::format("{}{}/rp_filter", kFolder, interface));
    if (std::max(all, own.value_or(0)) == kStrict) strict.push_back(interface);
  }
  if (strict.empty()) return ok("return path", "not filtered strictly");
  return {"return path", Verdict::kWarning,
          fmt::format("filtered strictly on {}", fmt::join(strict, ", ")),
          "packets of a sensor whose address is not routed by the same interface vanish without a "
          "trace, though tcpdump shows them",
          fmt::format("give the interface an address of the sensor's network, or sysctl -w "
                      "net.ipv4.conf.all.rp_filter=2 net.ipv4.conf.{}.rp_filter=2",
                      strict.front())};
}

Finding check_firewall(const SystemView& system, const Requests& requests) {
  std::vector<std::string> signs;
  for (const std::string& line : lines_of(system.text("etc/ufw/ufw.conf").value_or(""))) {
    if (line == "ENABLED=yes") signs.emplace_back("ufw");
  }
  if (system.processes().contains("firewalld")) signs.emplace_back("firewalld");
  const bool old_tables = !system.text("proc/net/ip_tables_names").value_or("").empty();
  const std::string modules = system.text("proc/modules").value_or("");
  if (old_tables) signs.emplace_back("iptables");
  if (line_after(modules, "nf_tables ")) signs.emplace_back("nftables");
  if (signs.empty()) return ok("firewall", "no sign of one");
  const std::string first = signs.front();
  const std::string mend = first == "ufw" ? fmt::format("ufw allow {}/udp", requests.port)
                           : first == "firewalld"
                               ? fmt::format(
                                     "firewall-cmd --permanent --add-port={}/udp && "
                                     "firewall-cmd --reload",
                                     requests.port)
                               : fmt::format(
                                     "nft list ruleset (iptables -L -n) as root shows whether "
                                     "UDP {} may come in",
                                     requests.port);
  const bool sure = first == "ufw" || first == "firewalld";
  if (!sure) return ok("firewall", fmt::format("{} loaded; {}", fmt::join(signs, ", "), mend));
  return {"firewall", Verdict::kWarning, fmt::format("active: {}", fmt::join(signs, ", ")),
          "it may throw the sensor's packets away; tcpdump shows them all the same", mend};
}

}  // namespace terracut::doctor
