// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "made_up_machine.hpp"

namespace terracut::doctor {
namespace {

class DoctorNetwork : public MadeUpMachine {
 protected:
  const Requests eth0_{.interface = "eth0"};
};

TEST_F(DoctorNetwork, WantsTheInterfaceUp) {
  expect(check_interface(system(), {}), Verdict::kProblem, "no network interface is up");
  interface("lo", "unknown");
  interface("wlan0", "down");
  expect(check_interface(system(), {}), Verdict::kProblem, "no network interface is up");
  expect(check_interface(system(), eth0_), Verdict::kProblem, "there is no eth0",
         "name one of: lo, wlan0");
  interface("eth0", "down");
  expect(check_interface(system(), eth0_), Verdict::kProblem, "eth0 is down",
         "ip link set eth0 up");
  interface("eth0", "up");
  expect(check_interface(system(), eth0_), Verdict::kOk, "eth0 is up");
  expect(check_interface(system(), {}), Verdict::kOk, "up: eth0");
  expect(check_interface(system(), {.interface = "lo"}), Verdict::kOk, "lo is unknown");
}

TEST_F(DoctorNetwork, WantsABufferForOneFrameAtLeast) {
  const std::string limit = "proc/sys/net/core/rmem_max";
  expect(check_receive_buffer(system(), {}), Verdict::kOk, "not known");
  file(limit, "212992\n");
  expect(check_receive_buffer(system(), {}), Verdict::kProblem,
         "208 KiB (rmem_max 212992) hold 32 ms", "net.core.rmem_max=8388608");
  file(limit, "1048576\n");
  expect(check_receive_buffer(system(), {}), Verdict::kWarning, "hold 156 ms", "60-terracut.conf");
  file(limit, "16777216\n");
  expect(check_receive_buffer(system(), {}), Verdict::kOk, "8192 KiB");
  file(limit, "212992\n");
  capabilities("0000000000001000");
  expect(check_receive_buffer(system(), {}), Verdict::kWarning, "the service has no such right",
         "net.core.rmem_max=8388608");
}

TEST_F(DoctorNetwork, FindsInterruptsByTheDevice) {
  interface("eth0");
  expect(check_interrupts(system(), eth0_), Verdict::kOk, "not known");
  file("sys/class/net/eth0/device/msi_irqs/45", "msix\n");
  file("sys/class/net/eth0/device/msi_irqs/46", "msix\n");
  file("proc/irq/45/smp_affinity_list", "0-1\n");
  file("proc/irq/46/smp_affinity_list", "0-3\n");
  file("proc/irq/46/effective_affinity_list", "3\n");
  expect(check_interrupts(system(), eth0_), Verdict::kOk, "45 on 0-1; 46 on 3");
  const Requests requests{.interface = "eth0", .core = 3};
  expect(check_interrupts(system(), requests), Verdict::kWarning, "46 on the frames' cores 3",
         "for i in 46; do");
  file("sys/devices/system/cpu/isolated", "1\n");
  expect(check_interrupts(system(), eth0_), Verdict::kWarning, "45 on the frames' cores 1");
}

TEST_F(DoctorNetwork, FindsInterruptsByTheirNames) {
  interface("eth0");
  file("proc/interrupts",
       "            CPU0       CPU1\n"
       "  24:         10          0   PCI-MSI 1-edge      eth0-TxRx-0\n"
       "  25:         10          0   PCI-MSI 2-edge      eth01\n"
       " NMI:          0          0   Non-maskable interrupts\n");
  file("proc/irq/24/smp_affinity_list", "1\n");
  file("proc/irq/25/smp_affinity_list", "1\n");
  expect(check_interrupts(system(), {.interface = "eth0", .core = 1}), Verdict::kWarning,
         "24 on the frames' cores 1 (24 on 1)");
}

TEST_F(DoctorNetwork, CountsWhatTheInterfaceLost) {
  interface("eth0");
  expect(check_interface_drops(system(), eth0_), Verdict::kOk, "not known");
  for (const char* counter :
       {"rx_missed_errors", "rx_fifo_errors", "rx_crc_errors", "rx_dropped"}) {
    file(std::string("sys/class/net/eth0/statistics/") + counter, "0\n");
  }
  expect(check_interface_drops(system(), eth0_), Verdict::kOk, "none since start");
  file("sys/class/net/eth0/statistics/rx_missed_errors", "12\n");
  expect(check_interface_drops(system(), eth0_), Verdict::kWarning, "eth0 rx_missed_errors 12",
         "ethtool -G");
}

TEST_F(DoctorNetwork, CountsWhatSocketsLost) {
  expect(check_socket_drops(system()), Verdict::kOk, "not known");
  const std::string head = "Tcp: A B\nTcp: 1 2\nUdp: InDatagrams NoPorts InErrors RcvbufErrors\n";
  file("proc/net/snmp", head + "Udp: 100 1 2 0\n");
  expect(check_socket_drops(system()), Verdict::kOk, "none since start");
  file("proc/net/snmp", head + "Udp: 100 1 2 7\n");
  expect(check_socket_drops(system()), Verdict::kWarning, "7 since start", "nstat");
  file("proc/net/snmp", head + "Udp: 100\n");
  expect(check_socket_drops(system()), Verdict::kOk, "not known");
}

TEST_F(DoctorNetwork, KnowsAPortThatIsTaken) {
  file("proc/net/udp",
       "  sl  local_address rem_address   st\n"
       "  10: 00000000:0940 00000000:0000 07\n");
  expect(check_port(system(), {.port = 2368}), Verdict::kWarning, "UDP 2368 is taken", "ss -ulpn");
  expect(check_port(system(), {.port = 2369}), Verdict::kOk, "UDP 2369 is free");
}

TEST_F(DoctorNetwork, WarnsOfAStrictReturnPath) {
  interface("eth0");
  const std::string conf = "proc/sys/net/ipv4/conf/";
  expect(check_return_path(system(), eth0_), Verdict::kOk, "not filtered strictly");
  file(conf + "all/rp_filter", "0\n");
  file(conf + "eth0/rp_filter", "1\n");
  expect(check_return_path(system(), eth0_), Verdict::kWarning, "strictly on eth0",
         "net.ipv4.conf.eth0.rp_filter=2");
  file(conf + "all/rp_filter", "2\n");  // the larger of the two holds
  expect(check_return_path(system(), eth0_), Verdict::kOk, "not filtered strictly");
}

TEST_F(DoctorNetwork, LooksForFirewalls) {
  expect(check_firewall(system(), {}), Verdict::kOk, "no sign");
  file("proc/modules", "nf_tables 303104 0 - Live 0x0\n");
  expect(check_firewall(system(), {}), Verdict::kOk, "nftables loaded; nft list ruleset");
  file("proc/net/ip_tables_names", "filter\n");
  expect(check_firewall(system(), {}), Verdict::kOk, "iptables, nftables loaded");
  process(300, "firewalld");
  expect(check_firewall(system(), {}), Verdict::kWarning, "firewalld", "--add-port=2368/udp");
  file("etc/ufw/ufw.conf", "# ufw\nENABLED=yes\n");
  expect(check_firewall(system(), {.port = 6699}), Verdict::kWarning, "ufw", "ufw allow 6699/udp");
}

}  // namespace
}  // namespace terracut::doctor
